// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/fill.hpp"

#include <cmath>
#include <limits>

#include "src/transfer/scalar_fields.hpp"

namespace whipple::transfer {

namespace {

/// Returns whether nodes that a particle reaches may be those of cells that the other level fills too.
bool is_near_change(const grid::Geometry& fine, const Vector3& position) {
  const Lanes cells = fine.in_cells(position), around = broadcast(6.0);
  return fine.levels.may_need(grid::Level::fine, cells, around) &&
         fine.levels.may_need(grid::Level::coarse, cells, around);
}

}  // namespace

std::vector<double> fill_of_cells(const Particles& particles, const TransitionNodes& elements,
                                  grid::BlockGrid& grid) {
  using grid::BlockGrid;
  using grid::Node;
  grid.clear();
  const bool two_levels = grid.has_two_levels();
  const grid::Geometry &fine = grid.geometry(), coarse = fine.of_level(grid::Level::coarse);
  const auto geometry_at = [&](const Vector3& x) -> const grid::Geometry& {
    return two_levels && fine.level_at(x) == grid::Level::coarse ? coarse : fine;
  };
  scalars::scatter(BlockGrid::Points::particles, grid,
                   [&](Node& node, std::size_t p, double n, const Vector3&) {
                     const double volume = particles.volume[p] + particles.void_volume[p];
                     const grid::Geometry& geometry = geometry_at(particles.position[p]);
                     const double dx = geometry.cell_size,
                                  per_cell = 1.0 / (dx * dx) / geometry.depth(particles.position[p]);
                     node.scalars.sums += Lanes{n * volume * per_cell, 0.0, 0.0, 0.0};
                   });
  if (elements.size() > 0) {
    scalars::scatter(BlockGrid::Points::guests, grid, [&](Node& node, std::size_t, double n, const Vector3&) {
      node.scalars.sums += Lanes{0.0, n, 0.0, 0.0};
    });
  }
  scalars::fold(grid);
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {  // images bring to it as much again
    for (const auto* nodes : {&plane.on_plane, &plane.on_plane_apart}) {
      for (const std::uint32_t node : *nodes) grid.all_nodes()[node].scalars.sums *= 2.0;
    }
  }
  grid.sum_to_owners(BlockGrid::Part::first);
  for (const std::uint32_t slot : grid.contact_slots().first(grid.owned_contact_slots())) {
    for (int i = 0; i < grid::nodes_per_block; ++i) {
      Lanes sum{};
      grid.fields(slot).for_each([&](unsigned field) { sum += grid.nodes(slot, field)[i].scalars.sums; });
      grid.fields(slot).for_each([&](unsigned field) { grid.nodes(slot, field)[i].scalars.sums = sum; });
    }
  }
  scalars::share(grid);
  std::vector<double> fill(particles.size(), std::numeric_limits<double>::infinity());
  scalars::gather(grid, [&](std::size_t p, auto&& for_nodes) {
    double filled = 0.0, of_elements = 0.0;
    for_nodes([&](const Node& node, double n, const Vector3&) {
      filled += n * node.scalars.sums[0];
      of_elements += n * node.scalars.sums[1];
    });
    if (of_elements == 0.0 && !(two_levels && is_near_change(fine, particles.position[p]))) fill[p] = filled;
  });
  return fill;
}

}  // namespace whipple::transfer

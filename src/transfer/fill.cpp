// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/fill.hpp"

#include <cmath>
#include <limits>

#include "src/transfer/scalar_fields.hpp"

namespace whipple::transfer {

std::vector<double> fill_of_cells(const Particles& particles, const TransitionNodes& elements,
                                  grid::BlockGrid& grid) {
  using grid::BlockGrid;
  using grid::Node;
  grid.clear();
  const double dx = grid.geometry().cell_size, per_area = 1.0 / (dx * dx);
  scalars::scatter(BlockGrid::Points::particles, grid,
                   [&](Node& node, std::size_t p, double n, const Vector3&) {
                     const double volume = particles.volume[p] + particles.void_volume[p];
                     const double per_cell = per_area / grid.geometry().depth(particles.position[p]);
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
    if (of_elements == 0.0) fill[p] = filled;
  });
  return fill;
}

}  // namespace whipple::transfer

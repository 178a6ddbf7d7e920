// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/plain_nodes.hpp"

/// Particles with functions of both levels (docs/theory/levels.md): a small fraction of all, by plain loops.
namespace whipple::transfer {

/// Returns whether a particle has functions of both levels; the kernels of one level pass it over.
[[gnu::always_inline]] inline bool is_mixed(const grid::BlockGrid& grid, std::size_t p) {
  const std::span<const std::uint32_t> number = grid.mixed_number();
  return !number.empty() && number[p] != grid::BlockGrid::not_mixed;
}

/// Calls f(node, AtNode) for the nodes of a part of a mixed particle, with its fraction of the functions (1).
template <class Function>
void for_each_node_of_part(const plain::Functions& functions, const Particles& particles,
                           grid::BlockGrid& grid, std::uint32_t part, double slope_smoothing, Function&& f) {
  constexpr auto kind = grid::BlockGrid::Points::parts;
  const grid::MixedParticle& mixed = grid.mixed_of_part(part);
  const std::size_t slot = grid.slot_of_part(part);
  const grid::Level level = grid::BlockGrid::level_of_part(part);
  const double share = mixed.blend.share(level);
  const Vector3 slope = mixed.blend.slope(level);
  plain::for_each_node(
      functions, particles, mixed.particle, grid.places(kind)[part], Cells(grid, slot, slope_smoothing),
      plain::NodesAround(grid, slot, grid.field_of_part(part), functions.stencil),
      [&](grid::Node& node, const plain::AtNode& at) {
        f(node, plain::AtNode{.n = share * at.n, .gradient = share * at.gradient + at.n * slope, .r = at.r});
      });
}

/// Returns sums over the nodes of a mixed particle on both levels, in the form that the plain kernels have them.
template <class Shape, class Sums>
typename Sums::Result sums_of_mixed(const Particles& particles, grid::BlockGrid& grid, std::size_t p,
                                    double slope_smoothing, const Sums& sums) {
  constexpr plain::Functions functions = plain::functions<Shape>();
  const std::uint32_t k = grid.mixed_number()[p];
  const double edge = grid.geometry().cell_size_at(grid.mixed()[k].blend);
  return sums.of(particles, p, functions.second_moment * edge * edge, [&](auto&& f) {
    for (const std::uint32_t part : {2 * k, 2 * k + 1})
      for_each_node_of_part(functions, particles, grid, part, slope_smoothing, f);
  });
}

/// Calls f(part) on threads for the parts in the slots of a region; parts that reach common nodes never concurrently.
template <class Function>
void for_each_part_apart(const grid::BlockGrid& grid, grid::BlockGrid::Region region, Function&& f) {
  if (grid.mixed().empty()) return;
  grid.for_each_apart(region, [&](std::size_t slot) {
    for (const std::uint32_t part : grid.parts_in(slot)) f(part);
  });
}

}  // namespace whipple::transfer

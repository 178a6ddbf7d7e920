// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "src/transfer/kernels/gather.hpp"
#include "src/transfer/kernels/scatter.hpp"
#include "src/transfer/mixed.hpp"

/// The kernels of one level for the parts of mixed particles (docs/theory/levels.md, 4 and 5). The fine part is one of the
/// particles of its block and costs no more than another; the coarse part is looked up by itself.
namespace whipple::transfer {

/// Returns whether parts of a level are left to the kernels that pass through the particles of a block: the fine ones,
/// but for the plain loops, which take (1) as it stands.
inline bool is_in_pass(grid::Level level) {
  return level == grid::Level::fine && kernel_set() != KernelSet::plain;
}

/// The nodes of a part of a mixed particle, and their weights in functions of its level.
template <class Shape>
struct PartInLevel {
  Cells cells;
  const grid::PlaceInStencil& place;
  Weights<Shape::count> weights;
  typename DirectAccess<Shape>::Stencil nodes;
  double share;
  Vector3 slope;  ///< of the share, 1/m

  PartInLevel(const Particles& particles, grid::BlockGrid& grid, std::uint32_t part, double slope_smoothing)
      : cells(grid, grid.slot_of_part(part), slope_smoothing),
        place(grid.places(grid::BlockGrid::Points::parts)[part]),
        weights(weights_at<Shape>(particles, grid.mixed_of_part(part).particle, place, cells)),
        nodes(DirectAccess<Shape>(grid, grid.slot_of_part(part), grid.field_of_part(part))
                  .stencil(place.first_node())),
        share(grid.mixed_of_part(part).blend.share(grid::BlockGrid::level_of_part(part))),
        slope(grid.mixed_of_part(part).blend.slope(grid::BlockGrid::level_of_part(part))) {}
};

/// Returns a contribution in the form that the functions of one level distribute (5): that of a particle times its share
/// there, the forces on the slope of the share in the place of external ones.
/// @param slope  1/m
[[gnu::always_inline]] inline Payload in_level(const Payload& load, double share, const Vector3& slope) {
  const auto times = [&](Lanes v) { return share * v; };
  return {.a0 = times(load.a0),
          .ax = times(load.ax),
          .ay = times(load.ay),
          .az = times(load.az),
          .b0 = times(load.b0) + slope[0] * load.bx + slope[1] * load.by + slope[2] * load.bz,
          .bx = times(load.bx),
          .by = times(load.by),
          .bz = times(load.bz)};
}
[[gnu::always_inline]] inline Lanes in_level(Lanes load, double share, const Vector3&) {
  return share * load;
}

/// Returns what a particle adds to the nodes of its block: of a mixed one that is its fine part.
template <class Load>
[[gnu::always_inline]] inline Load in_pass(const grid::BlockGrid& grid, std::size_t p, const Load& load) {
  if (!is_mixed(grid, p)) return load;
  if (!is_in_pass(grid::Level::fine)) return Load{};
  const grid::Blend& blend = grid.mixed()[grid.mixed_number()[p]].blend;
  return in_level(load, blend.fine, blend.gradient);
}

/// Adds the contribution of a part to its nodes.
template <class Shape, class Load>
void add_part(const Particles& particles, grid::BlockGrid& grid, std::uint32_t part, double slope_smoothing,
              const Load& load) {
  if (kernel_set() == KernelSet::plain) {
    for_each_node_of_part(
        plain::functions<Shape>(), particles, grid, part, slope_smoothing,
        [&](grid::Node& node, const plain::AtNode& at) { plain::Kernels::add(load, at, node); });
    return;
  }
  const PartInLevel<Shape> in(particles, grid, part, slope_smoothing);
  add_payload<Lanes, Shape>(in_level(load, in.share, in.slope), in.weights, in.nodes);
}

/// Returns sums with the functions of both levels from those with the functions of each (4).
inline ValueAndGradient<> together(const ValueAndGradient<>& fine, const ValueAndGradient<>& coarse,
                                   const grid::Blend& blend) {
  const double w = blend.fine;
  const Lanes difference = fine.value - coarse.value;
  ValueAndGradient<> sums{w * fine.value + (1.0 - w) * coarse.value, {}};
  for (std::size_t a = 0; a < 3; ++a) {
    sums.gradient[a] = w * fine.gradient[a] + (1.0 - w) * coarse.gradient[a] +
                       blend.gradient[static_cast<Eigen::Index>(a)] * difference;
  }
  return sums;
}

/// Returns the step of a mixed particle, by plain loops.
template <class Shape, bool affine>
Advance<> advance_mixed(const Particles& particles, grid::BlockGrid& grid, std::size_t p,
                        double slope_smoothing, AffineField field, double dt) {
  return sums_of_mixed<Shape>(particles, grid, p, slope_smoothing, plain::Transfer<affine>{field, dt});
}
/// The same by the kernels for registers.
/// @param fine  sums over the nodes of its block
template <class Shape, bool affine>
Advance<> advance_mixed(const Particles& particles, grid::BlockGrid& grid, std::size_t p,
                        double slope_smoothing, AffineField field, double dt, const Moments<Lanes>& fine) {
  const TransferSums<Lanes, affine> transfer{field, dt};
  const PointsOfGroup<Lanes> point = {static_cast<std::uint32_t>(p)};
  const std::uint32_t k = grid.mixed_number()[p];
  const PartInLevel<Shape> in(particles, grid, 2 * k + 1, slope_smoothing);
  const Group<Lanes, Shape, DirectAccess<Shape>> group{point, {&in.place}, {&in.weights}, {in.nodes}};
  const Moments<Lanes> coarse = transfer.of(particles, group, in.cells);
  const grid::Blend& blend = grid.mixed()[k].blend;
  const grid::Blend without_slope{blend.fine, Vector3::Zero()};  // moments take none
  const Moments<Lanes> sums = {.velocity = together(fine.velocity, coarse.velocity, blend),
                               .increment = together(fine.increment, coarse.increment, blend),
                               .change = together(fine.change, coarse.change, without_slope),
                               .loss = blend.fine * fine.loss + (1.0 - blend.fine) * coarse.loss};
  return transfer.template advance<Shape>(particles, point, sums, grid.geometry().cell_size_at(blend));
}

}  // namespace whipple::transfer

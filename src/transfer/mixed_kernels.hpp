// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "src/transfer/kernels/gather.hpp"
#include "src/transfer/kernels/scatter.hpp"
#include "src/transfer/mixed.hpp"

/// The kernels of one level, called for both parts of a mixed particle (docs/theory/levels.md, 4 and 5).
namespace whipple::transfer {

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
template <class Shape>
Payload in_level(const Payload& load, const PartInLevel<Shape>& part) {
  const auto times = [&](Lanes v) { return part.share * v; };
  return {.a0 = times(load.a0),
          .ax = times(load.ax),
          .ay = times(load.ay),
          .az = times(load.az),
          .b0 = times(load.b0) + part.slope[0] * load.bx + part.slope[1] * load.by + part.slope[2] * load.bz,
          .bx = times(load.bx),
          .by = times(load.by),
          .bz = times(load.bz)};
}
template <class Shape>
Lanes in_level(Lanes load, const PartInLevel<Shape>& part) {
  return part.share * load;
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
  add_payload<Lanes, Shape>(in_level(load, in), in.weights, in.nodes);
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

/// Returns the step of a mixed particle.
template <class Shape, bool affine>
Advance<> advance_mixed(const Particles& particles, grid::BlockGrid& grid, std::size_t p,
                        double slope_smoothing, AffineField field, double dt) {
  if (kernel_set() == KernelSet::plain)
    return sums_of_mixed<Shape>(particles, grid, p, slope_smoothing, plain::Transfer<affine>{field, dt});
  const TransferSums<Lanes, affine> transfer{field, dt};
  const PointsOfGroup<Lanes> point = {static_cast<std::uint32_t>(p)};
  const std::uint32_t k = grid.mixed_number()[p];
  const auto in_one_level = [&](std::uint32_t part) {
    const PartInLevel<Shape> in(particles, grid, part, slope_smoothing);
    const Group<Lanes, Shape, DirectAccess<Shape>> group{point, {&in.place}, {&in.weights}, {in.nodes}};
    return transfer.of(particles, group, in.cells);
  };
  const Moments<Lanes> fine = in_one_level(2 * k), coarse = in_one_level(2 * k + 1);
  const grid::Blend& blend = grid.mixed()[k].blend;
  const grid::Blend without_slope{blend.fine, Vector3::Zero()};  // moments take none
  const Moments<Lanes> sums = {.velocity = together(fine.velocity, coarse.velocity, blend),
                               .increment = together(fine.increment, coarse.increment, blend),
                               .change = together(fine.change, coarse.change, without_slope),
                               .loss = blend.fine * fine.loss + (1.0 - blend.fine) * coarse.loss};
  return transfer.template advance<Shape>(particles, point, sums, grid.geometry().cell_size_at(blend));
}

}  // namespace whipple::transfer

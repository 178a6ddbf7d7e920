// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "src/core/base/simd.hpp"
#include "src/core/base/tensor.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/grid/block_grid.hpp"
#include "src/transfer/shapes.hpp"

/// Weights of the three directions at a point.
namespace whipple::transfer {

/// Half-sizes (in cells) of the box along the axes that has the second moments of the particle's domain:
/// extent_aa is the sum over its half-edges r of r_a^2 (docs/theory/mpm.md, equation 2.3).
inline Vector3 half_sizes(const SymmetricTensor& extent, double cell_size) {
  return Vector3(std::sqrt(extent.xx), std::sqrt(extent.yy), std::sqrt(extent.zz)) / cell_size;
}

/// Weights of all three directions.
template <int Count>
struct Weights : AxisWeights<Count, Lanes> {
  std::int32_t first_node;  ///< as of grid::PlaceInStencil
};

/// Values of one direction for all nodes of a stencil, each in all lanes.
template <std::size_t Count>
[[gnu::always_inline]] inline std::array<Lanes, Count> of_direction(const std::array<Lanes, Count>& values,
                                                                    std::size_t direction) {
  std::array<Lanes, Count> all;
  for (std::size_t k = 0; k < Count; ++k) all[k] = broadcast(values[k][direction]);
  return all;
}

/// Sets the weights of the one node along z.
template <int Count>
[[gnu::always_inline]] inline void set_flat(Weights<Count>& w) {
  w.weight[0][2] = 1.0;
  w.derivative[0][2] = w.distance[0][2] = 0.0;
}

/// Weights of all three directions for a particle, or another point.
template <class Shape, class Points>
[[gnu::always_inline]] inline Weights<Shape::count> weights_at(const Points& points, std::size_t p,
                                                               const grid::PlaceInStencil& place,
                                                               const Cells& cells) {
  const Lanes from_first = place.from_first();
  if constexpr (Sized<Shape>) {
    const Vector3 h = half_sizes(points.extent[p], cells.size);
    Weights<Shape::count> all{};
    all.first_node = place.first_node();
    for (int a = 0; a < 3; ++a) {
      const AxisWeights<Shape::count> axis = Shape::weights(from_first[a], h[a], cells);
      for (std::size_t i = 0; i < Shape::count; ++i) {
        all.weight[i][a] = axis.weight[i];
        all.derivative[i][a] = axis.derivative[i];
        all.distance[i][a] = axis.distance[i];
      }
    }
    if constexpr (Planar<Shape>) set_flat(all);
    return all;
  } else if constexpr (Planar<Shape>) {
    Weights<Shape::count> all{Shape::weights(from_first, cells), place.first_node()};
    set_flat(all);
    return all;
  } else {
    return {Shape::weights(from_first, cells), place.first_node()};
  }
}

}  // namespace whipple::transfer

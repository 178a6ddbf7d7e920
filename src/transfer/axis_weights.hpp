// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "src/core/base/dialect.hpp"

/// Weights of the nodes along one direction, as formulas of one point (docs/theory/mpm.md, section 2).
namespace whipple::transfer {

/// Weights, slopes and distances of the nodes that a particle reaches along one direction, from its
/// distance to the first of them in cells: `shift` to `shift` + 1 of the stencil.
/// @tparam Number double, or a register of the three directions at once (lane = direction)
template <int Count, class Number = double>
struct AxisWeights {
  std::array<Number, Count> weight;      ///< N
  std::array<Number, Count> derivative;  ///< S: dN/dx, or its smoother form, 1/m
  std::array<Number, Count> distance;    ///< node position minus particle position, m
};

namespace formulas {

/// Returns the weights of quadratic B-splines.
/// @param g          position in cells from the first node, 0.5 to 1.5
/// @param cell_size  m
/// @param smoothing  a1 of the slopes (2.9); 0: the derivatives of N
template <class Number>
[[gnu::always_inline]] WHIPPLE_POINT inline AxisWeights<3, Number> quadratic_weights(
    const Number& g, double cell_size, const Number& smoothing) {
  AxisWeights<3, Number> w;
  const double per_cell = 1.0 / cell_size;
  const Number y = g - 1.0, slope = y + (smoothing * y) * (0.25 - y * y);
  w.weight = {0.5 * (1.5 - g) * (1.5 - g), 0.75 - (g - 1.0) * (g - 1.0), 0.5 * (g - 0.5) * (g - 0.5)};
  w.derivative = {(slope - 0.5) * per_cell, slope * (-2.0 * per_cell), (slope + 0.5) * per_cell};
  w.distance = {-g * cell_size, (1.0 - g) * cell_size, (2.0 - g) * cell_size};
  return w;
}

}  // namespace formulas
}  // namespace whipple::transfer

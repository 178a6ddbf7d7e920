// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/core/base/dialect.hpp"

namespace whipple::strength {

/// Flow stress of the solid (Pa) and its slope by the increment of the equivalent plastic strain.
struct FlowStress {
  double value;
  double slope;
};

/// The increment x >= 0 of the equivalent plastic strain that solves q - 3 G x - w Y(x) = 0
/// (docs/theory/material.md, eq. 7), by Newton's method inside a bracket that shrinks from both sides; where
/// a step would leave it, the bracket is divided (geometrically, since Y may rise like the logarithm or a
/// small power of x). 0 where q <= w Y_least.
/// @param trial    q, Pa
/// @param modulus  G, Pa, > 0
/// @param solid    w
/// @param least    Y_least, a lower bound of Y(x) for all x >= 0, Pa
/// @param flow     flow(x) -> FlowStress for x > 0; q - 3 G x - w Y(x) must fall with x
/// @param start    from which the iteration starts, if it lies inside the bracket
template <class Flow>
WHIPPLE_POINT double radial_return_from(double start, double trial, double modulus, double solid,
                                        double least, Flow&& flow) {
  const double stiffness = 3.0 * modulus;
  if (trial <= solid * least) return 0.0;
  double lower = 0.0, upper = (trial - solid * least) / stiffness;
  double x = start > lower && start < upper ? start : upper;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const FlowStress y = flow(x);
    const double residual = trial - stiffness * x - solid * y.value;
    if (std::abs(residual) <= 1e-12 * trial) break;
    (residual > 0.0 ? lower : upper) = x;
    if (upper - lower <= 1e-15 * upper || upper < 1e-30) return lower;  // yields at no strain: elastic
    const double newton = x + residual / (stiffness + solid * y.slope);
    x = newton > lower && newton < upper ? newton : lower > 0.0 ? std::sqrt(lower * upper) : 1e-3 * upper;
  }
  return x;
}

/// Finds the same from the upper end of the bracket.
template <class Flow>
WHIPPLE_POINT double radial_return(double trial, double modulus, double solid, double least, Flow&& flow) {
  return radial_return_from(0.0, trial, modulus, solid, least, flow);
}

}  // namespace whipple::strength

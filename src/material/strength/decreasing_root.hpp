// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace whipple::strength {

/// Finds the root of a decreasing function between 0, where it is positive, and `upper`, where it is not, by false
/// position (Illinois); to the last digits, in a bounded number of steps.
template <class Function>
double decreasing_root(double at_zero, double upper, Function function) {
  double a = 0.0, fa = at_zero, b = upper, fb = function(upper);
  for (int i = 0; i < 100 && b - a > 1e-15 * b && fb != 0.0; ++i) {
    const double x = std::clamp((a * fb - b * fa) / (fb - fa), a, b), fx = function(x);
    if (fx > 0.0) {
      a = x;
      fa = fx;
      fb *= 0.5;
    } else {
      b = x;
      fb = fx;
      fa *= 0.5;
    }
    if (std::abs(fx) <= 1e-14 * at_zero) return x;
  }
  return b;
}

}  // namespace whipple::strength

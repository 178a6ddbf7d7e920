// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple::eos {

/// Computes the reference pressure of a shock Hugoniot in the form of Steinberg, UCRL-MA-106439 (1996),
///   Us = C + S1 up + S2 (up/Us) up + S3 (up/Us)^2 up,
/// which gives the pressure in closed form: with x = 1 - V/V0 = up/Us
///   p_H = rho0 C^2 x/(1 - S1 x - S2 x^2 - S3 x^3)^2.
/// S2 = S3 = 0: the linear Hugoniot. The same formula is used for x < 0 (tension).
struct ShockCurve {
  double slope = 0;      ///< S1
  double quadratic = 0;  ///< S2
  double cubic = 0;      ///< S3

  /// Holds a function of x and its first two derivatives, for a number or Lanes.
  template <class Number>
  struct Derivatives {
    Number value, slope, curvature;
  };
  using Value = Derivatives<double>;

  /// Returns y = 1 - S1 x - S2 x^2 - S3 x^3; the pole of the pressure is its first zero.
  template <class Number>
  [[nodiscard]] Derivatives<Number> denominator(Number x) const {
    return {1.0 - x * (slope + x * (quadratic + x * cubic)), -slope - x * (2.0 * quadratic + 3.0 * x * cubic),
            -2.0 * quadratic - 6.0 * x * cubic};
  }
  /// Returns p_H/(rho0 C^2) = x/y^2.
  template <class Number>
  [[nodiscard]] Derivatives<Number> pressure(Number x) const {
    const Derivatives<Number> y = denominator(x);
    const Number inverse = 1.0 / y.value, square = inverse * inverse, cube = square * inverse;
    const Number value = x * square;
    const Number first = square - 2.0 * x * cube * y.slope;
    const Number second =
        -4.0 * cube * y.slope + 6.0 * x * square * square * y.slope * y.slope - 2.0 * x * cube * y.curvature;
    return {value, first, second};
  }
  /// Returns the largest x, at most `bound`, up to which y stays above `margin` (y = 1 at x = 0).
  [[nodiscard]] double limit(double margin, double bound) const {
    constexpr int steps = 4000;
    for (int i = 1; i <= steps; ++i) {
      const double x = bound * i / steps;
      if (denominator(x).value >= margin) continue;
      double low = bound * (i - 1) / steps, high = x;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (denominator(middle).value >= margin ? low : high) = middle;
      }
      return low;
    }
    return bound;
  }
};

}  // namespace whipple::eos

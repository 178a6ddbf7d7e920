// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/core/base/dialect.hpp"
#include "src/core/base/vector_math.hpp"

/// First guess of the return of Johnson-Cook (docs/theory/material.md, eq. 7).
namespace whipple::strength::formulas {

constexpr double least_strain = 1e-300;  ///< largest strain whose power counts as 0

/// Returns the root of z + ln z = K by the asymptotic series of Wright's omega function (R. M. Corless and D. J.
/// Jeffrey, LNCS 2385 (2002) 76), approximately for K < 1, and one step of fourth order (F. N. Fritsch, R. E. Shafer
/// and W. P. Crowley, Commun. ACM 16 (1973) 123).
/// @param exponential  exp(min(K, 1))
WHIPPLE_POINT inline double omega(double argument, double exponential) {
  const double K = std::max(argument, 1.0), ln_K = rough_log(K), inverse = 1.0 / K;
  double z = argument < 1.0 ? exponential / (1.0 + exponential)
                            : K - ln_K + ln_K * inverse * (1.0 + (0.5 * ln_K - 1.0) * inverse);
  z = std::max(z, std::numeric_limits<double>::min());
  const double miss = argument - z - rough_log(z), after = 1.0 + z,
               q = 2.0 * after * (after + (2.0 / 3.0) * miss);
  return z + z * (miss * (q - miss)) / (after * (q - 2.0 * miss));
}

/// Returns ep^n; 0 for strains that are too small.
WHIPPLE_POINT inline double power_of_strain(double strain, double exponent) {
  return strain > least_strain ? std::exp(exponent * std::log(strain)) : 0.0;
}

/// Point before the return.
struct YieldingPoint {
  double trial;      ///< q, Pa
  double stiffness;  ///< 3 G, Pa
  double softening;  ///< w (1 - T*^m)
  double strain;     ///< before the step
  double power;      ///< its power n, 0 without hardening
};

/// Returns the increment for linear hardening with rate effect, corrected for the contribution of the rate to the
/// hardening: x is the root of S x + a ln(x/l) = b with b = q - w Y(ep, 0, T), a = C w Y and l the increment at the
/// reference rate, x = z a/S with z + ln z = b/a - ln(a/(S l)). Not positive if the point does not yield.
/// @param law    with the constants of JohnsonCook
/// @param least  l
template <class Law>
WHIPPLE_POINT inline double rate_dependent_start(const Law& law, const YieldingPoint& point, double least) {
  const double yield = point.softening * (law.yield_stress + law.hardening_coefficient * point.power);
  const double excess = point.trial - yield, upper = excess / point.stiffness;
  if (!(excess > 0.0)) return 0.0;
  const double slope = point.stiffness + point.softening *
                                             (law.hardening_coefficient * law.hardening_exponent) *
                                             point.power / std::max(point.strain, upper);
  const double linear = excess / slope;
  if (!(law.rate_coefficient > 0.0)) return linear;
  const double a = std::max(law.rate_coefficient * yield, 1e-9 * excess), scale = a / slope;
  const double logarithm = rough_log(scale / least), argument = excess / a - logarithm;
  double z = omega(argument, std::exp(std::min(argument, 1.0)));
  const double rate_logarithm = argument - z + logarithm;
  z -= z * z / (1.0 + z) * ((slope - point.stiffness) / slope * (law.rate_coefficient * rate_logarithm));
  return std::min(linear, std::max(scale * z, least));
}

}  // namespace whipple::strength::formulas

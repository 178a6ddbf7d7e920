// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>

/// Strength of brittle material over its damage, and the return to it.
namespace whipple::strength {

/// Describes the strength at a pressure and a rate, linear in the damage up to a bound, Y = min(whole - D fall,
/// greatest), not below 0, and the plastic strain over which the damage increases from 0 to 1.
struct BrittleSurface {
  double whole;     ///< at D = 0, Pa
  double fall;      ///< >= 0, Pa
  double greatest;  ///< Pa
  double failure_strain;

  [[nodiscard]] double strength(double damage) const {
    return std::clamp(whole - damage * fall, 0.0, std::max(greatest, 0.0));
  }
};

struct BrittleReturn {
  double increment;  ///< of the equivalent plastic strain
  double damage;     ///< after the return
};

/// Returns the closed solution of q - 3 G x = Y(D + x/eps_f), the return to a surface that decreases during the return
/// (docs/theory/concrete_and_ceramics.md, eq. 8). Where it decreases faster than the stress, the point breaks at once:
/// D = 1.
inline BrittleReturn brittle_return(double trial, double stiffness, const BrittleSurface& y, double damage) {
  if (trial <= y.strength(damage)) return {0.0, damage};
  if (damage < 1.0 && y.failure_strain > 0.0) {
    const double excess = trial - (y.whole - damage * y.fall), slope = stiffness - y.fall / y.failure_strain;
    double x = std::max(0.0, (trial - y.greatest) / stiffness);
    if (excess > 0.0) x = slope > 0.0 ? std::max(x, excess / slope) : std::numeric_limits<double>::infinity();
    const double grown = damage + x / y.failure_strain;
    if (grown < 1.0) return {std::min(x, trial / stiffness), grown};
  }
  return {std::max(0.0, trial - y.strength(1.0)) / stiffness, 1.0};
}

}  // namespace whipple::strength

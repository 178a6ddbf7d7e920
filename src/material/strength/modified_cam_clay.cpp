// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/strength/modified_cam_clay.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/material/strength/decreasing_root.hpp"

namespace whipple::strength {
namespace {

/// Describes a point whose pressure follows from the increment of its flow.
struct Flow {
  double trial, stiffness;  // Pa
  double length;            // p_c before the step, Pa
  double hardening;         // K h, Pa

  [[nodiscard]] double length_at(double pressure) const {
    return length * std::exp(-(pressure - trial) / hardening);
  }
  /// Returns the root of p - p_t + K x (2 p - p_c(p)), which increases and is concave in p: Newton's method converges,
  /// from the second iterate on from below.
  [[nodiscard]] double pressure(double x) const {
    double p = trial;
    for (int i = 0; i < 50; ++i) {
      const double now = length_at(p);
      const double step =
          (p - trial + stiffness * x * (2.0 * p - now)) / (1.0 + stiffness * x * (2.0 + now / hardening));
      p -= step;
      if (std::abs(step) <= 1e-15 * (std::abs(trial) + length)) break;
    }
    return p;
  }
};

}  // namespace

ParameterTable<ModifiedCamClay> ModifiedCamClay::parameters() {
  using P = ModifiedCamClay;
  return ElasticConstants::parameters<P>(
      {real("critical_state_slope", &P::critical_state_slope, "", range::positive(),
            "M, q/p of flow at constant volume"),
       real("preconsolidation_pressure", &P::preconsolidation_pressure, "Pa", range::positive(),
            "p_c0, pressure at which the soil as it is begins to compact"),
       real("plastic_compressibility", &P::plastic_compressibility, "", range::positive(),
            "h = lambda* - kappa*: -d(ln J_p)/d(ln p) of virgin compression"),
       real("maximum_dilation", &P::maximum_dilation, "",
            Range{.lower = 0.0, .upper = 0.5, .lower_open = true},
            "ln J_p at which dilation, and with it softening, has ended")
           .optional()});
}

double ModifiedCamClay::growth(const DilatingPoint& point) const {
  const double square = critical_state_slope * critical_state_slope, shear = 6.0 * point.modulus / square;
  const Flow flow{point.pressure, point.stiffness, length(point.distension),
                  point.stiffness * plastic_compressibility};
  const auto excess = [&](double x) {
    const double q = point.trial / (1.0 + shear * x), p = flow.pressure(x);
    return q * q / square + p * (p - flow.length_at(p));
  };
  const double at_zero = excess(0.0);
  if (!(at_zero > 0.0)) return 0.0;
  const double wide = 2.0 * point.pressure - flow.length;
  // Of the linear return without hardening
  double upper = at_zero / (2.0 * shear * point.trial * point.trial / square + point.stiffness * wide * wide);
  for (int i = 0; i < 200 && excess(upper) > 0.0; ++i) upper *= 2.0;
  const double x = decreasing_root(at_zero, upper, excess);
  const double grown = (flow.pressure(x) - point.pressure) / point.stiffness;
  return std::min(grown, std::max(0.0, maximum_dilation - std::log(point.distension)));
}

}  // namespace whipple::strength

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/core/base/dialect.hpp"
#include "src/material/failure/code.hpp"

/// Growth of voids of one point, from the constants of a law with the members of ViscousVoidGrowth
/// (viscous_void_growth.hpp).
namespace whipple::failure::formulas {

/// Returns P_s (Pa) for a resistance (Pa).
WHIPPLE_POINT inline double static_pressure(double resistance, double alpha) {
  return resistance / alpha * std::log(alpha / (alpha - 1.0));
}

/// Describes a point in the step: volume that is moved from the material to the void changes both alpha and the
/// pressure.
struct VoidPoint {
  double volume, void_volume;  ///< m^3
  double pressure, modulus;    ///< Pa
  double resistance;           ///< with melting and scatter, Pa
  double viscosity;            ///< with melting, Pa s
};

template <class Law>
WHIPPLE_POINT inline double distension(const Law& law, const VoidPoint& point, double moved) {
  return 1.0 + law.nuclei + (point.void_volume + moved) / (point.volume - moved);
}

/// Returns the excess of the growth of alpha over that allowed by the rate; 0 at the end of the step.
/// @param moved  volume moved from material to void, m^3
/// @param sign   1: in tension, -1: in compression
template <class Law>
WHIPPLE_POINT inline double excess_growth(const Law& law, const VoidPoint& point, double moved, double sign,
                                          double time_step) {
  const double alpha = distension(law, point, moved);
  const double mean = (point.pressure + point.modulus * moved / point.volume) / alpha;
  const double drive = -mean - sign * static_pressure(point.resistance, alpha);
  const double rate = std::cbrt(law.nuclei * law.nuclei * (alpha - 1.0)) * alpha / point.viscosity * drive;
  return alpha - distension(law, point, 0.0) - time_step * rate;
}

/// Returns the volume (m^3) that moves from material to void in the step; negative if the void closes.
template <class Law>
WHIPPLE_POINT inline double moved_volume(const Law& law, const VoidPoint& point, double time_step) {
  constexpr double greatest_step = 0.1;  // fraction of the material's volume
  const double sign = point.pressure < 0.0 ? 1.0 : -1.0;
  const double at_rest = excess_growth(law, point, 0.0, sign, time_step);
  if (sign * at_rest >= 0.0) return 0.0;  // within the static pressures
  double from = 0.0, at_from = at_rest;
  double to = sign > 0.0 ? -point.pressure / point.modulus * point.volume : -point.void_volume;
  to = std::clamp(to, -greatest_step * point.volume, greatest_step * point.volume);
  double at_to = excess_growth(law, point, to, sign, time_step);
  if (sign * at_to <= 0.0) return to;
  double moved = to;
  for (int iteration = 0; iteration < 100; ++iteration) {  // regula falsi (Illinois)
    moved = (from * at_to - to * at_from) / (at_to - at_from);
    const double value = excess_growth(law, point, moved, sign, time_step);
    if (std::abs(value) <= 1e-12 || std::abs(to - from) <= 1e-14 * point.volume) break;
    if (sign * value < 0.0) {
      from = moved;
      at_from = value;
      at_to *= 0.5;
    } else {
      to = moved;
      at_to = value;
      at_from *= 0.5;
    }
  }
  return moved;
}

/// Returns the tension (Pa) from which the nuclei grow, over the resistance.
WHIPPLE_POINT inline double tension_at_nuclei(double nuclei) {
  return static_pressure(1.0, 1.0 + nuclei) * (1.0 + nuclei);
}

/// Returns whether an intact point has voids, or opens them.
/// @param at_nuclei  tension_at_nuclei(law.nuclei)
/// @param strength   resistance of the point, Pa
WHIPPLE_POINT inline bool may_grow(double at_nuclei, double strength, double pressure, double void_volume) {
  return void_volume > 0.0 || !(pressure >= -strength * at_nuclei);
}

/// Grows the voids of such a point over the step.
/// @param bulk_modulus  rho c^2, Pa, @param solid  mass fraction that has not melted, @param strength  Pa
/// @param pressure, volume, void_volume  Pa, m^3; in and out
/// @returns the cause of its failure, or `intact`
template <class Law>
WHIPPLE_POINT inline Code grow_voids(const Law& law, double time_step, double bulk_modulus, double solid,
                                     double strength, double& pressure, double& volume, double& void_volume) {
  if (!(strength > 0.0)) return tensile;
  const VoidPoint point = {volume, void_volume, pressure, bulk_modulus, strength, law.viscosity * solid};
  const double moved = moved_volume(law, point, time_step);
  const double total = point.volume + point.void_volume;
  pressure += point.modulus * moved / point.volume;
  volume = std::min(point.volume - moved, total);
  void_volume = total - volume;
  return void_volume >= law.failure_porosity * total ? void_growth : intact;
}

}  // namespace whipple::failure::formulas

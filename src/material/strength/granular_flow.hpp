// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/material/strength/brittle.hpp"

namespace whipple::strength {

/// Dense flow of dry grains, mu(I): friction that increases with the inertial number,
///   q <= sqrt(3) p mu(I),   mu = mu_s + (mu_2 - mu_s)/(1 + I_0/I),   I = g d sqrt(rho_g/p),   p >= 0,
/// g the rate of shear, sqrt(3) times the equivalent strain rate; no cohesion, no dilation. Source: P. Jop, Y. Forterre,
/// O. Pouliquen, Nature 441 (2006) 727. docs/theory/soil.md, section 4.
struct GranularFlow : ElasticConstants {
  double static_friction = 0.0;    ///< mu_s
  double limiting_friction = 0.0;  ///< mu_2
  double reference_number = 0.0;   ///< I_0
  double grain_size = 0.0;         ///< d, m
  double grain_density = 0.0;      ///< rho_g, kg/m^3

  static ParameterTable<GranularFlow> parameters() {
    using P = GranularFlow;
    return ElasticConstants::parameters<P>(
        {real("static_friction", &P::static_friction, "", range::positive(), "mu_s, of slow shear"),
         real("limiting_friction", &P::limiting_friction, "", range::positive(), "mu_2, of fast shear"),
         real("reference_number", &P::reference_number, "", range::positive(),
              "I_0: inertial number of the mean of both"),
         real("grain_size", &P::grain_size, "m", range::positive(), "d, diameter of the grains"),
         real("grain_density", &P::grain_density, "kg/m^3", range::positive(), "rho_g, of a grain")});
  }
  static constexpr bool keeps_strength = true;
  static constexpr const char* name = "granular_flow";
  static constexpr const char* summary = "dry grains: friction by the inertial number, mu(I)";
  static constexpr const char* theory =
      "q <= sqrt(3) p mu(I), mu = mu_s + (mu_2 - mu_s)/(1 + I_0/I), I = g d sqrt(rho_g/p), g = sqrt(3) times "
      "the equivalent strain rate; a gap opens at p = 0.\n"
      "Source: Jop, Forterre and Pouliquen, Nature 441 (2006) 727.";

  /// @throws InputError if the friction decreases with the rate
  void require_consistent() const {
    if (limiting_friction < static_friction)
      throw InputError("'limiting_friction' must not be below 'static_friction'");
  }
  /// Returns mu(I).
  [[nodiscard]] double friction(double inertial_number) const {
    return static_friction +
           (limiting_friction - static_friction) * inertial_number / (inertial_number + reference_number);
  }
  static double least_pressure(const BrittlePoint&) { return 0.0; }
  static double crushed_strain(const BrittlePoint&) { return 0.0; }
  [[nodiscard]] BrittleSurface surface(const BrittlePoint& point) const {
    const double p = std::max(point.pressure, 0.0);
    const double number =
        p > 0.0 ? std::numbers::sqrt3 * point.rate * grain_size * std::sqrt(grain_density / p) : 0.0;
    return {.whole = std::numbers::sqrt3 * p * friction(number),
            .fall = 0.0,
            .greatest = std::numeric_limits<double>::infinity(),
            .failure_strain = std::numeric_limits<double>::infinity()};
  }
};

using GranularFlowModel = BrittleModel<GranularFlow>;

}  // namespace whipple::strength

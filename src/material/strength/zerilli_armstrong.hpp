// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/flow_law_model.hpp"
#include "src/material/strength/radial_return.hpp"

namespace whipple::strength {

/// Zerilli-Armstrong flow stress from thermally activated motion of dislocations, one formula for both
/// crystal structures,
///   Y = C0 + (C1 + C2 sqrt(ep)) exp[(-C3 + C4 ln rate) T] + C5 ep^n:
/// C1 = C5 = 0 for face-centred, C2 = 0 for body-centred cubic metals. The rate is taken in 1/s and not below
/// `least_rate`. Source: F. J. Zerilli, R. W. Armstrong, J. Appl. Phys. 61 (1987) 1816.
struct ZerilliArmstrong : ElasticConstants {
  double athermal_stress = 0.0;        ///< C0, Pa
  double thermal_stress = 0.0;         ///< C1, Pa
  double thermal_hardening = 0.0;      ///< C2, Pa
  double thermal_coefficient = 0.0;    ///< C3, 1/K
  double rate_coefficient = 0.0;       ///< C4, 1/K
  double hardening_coefficient = 0.0;  ///< C5, Pa
  double hardening_exponent = 0.5;     ///< n
  double least_rate = 1e-3;            ///< 1/s

  static ParameterTable<ZerilliArmstrong> parameters() {
    using P = ZerilliArmstrong;
    return ElasticConstants::parameters<P>(
        {real("athermal_stress", &P::athermal_stress, "Pa", range::non_negative(), "C0"),
         real("thermal_stress", &P::thermal_stress, "Pa", range::non_negative(), "C1 (body-centred cubic)")
             .optional(),
         real("thermal_hardening", &P::thermal_hardening, "Pa", range::non_negative(),
              "C2 (face-centred cubic)")
             .optional(),
         real("thermal_coefficient", &P::thermal_coefficient, "1/K", range::positive(), "C3"),
         real("rate_coefficient", &P::rate_coefficient, "1/K", range::non_negative(), "C4"),
         real("hardening_coefficient", &P::hardening_coefficient, "Pa", range::non_negative(),
              "C5 (body-centred cubic)")
             .optional(),
         real("hardening_exponent", &P::hardening_exponent, "", range::positive(), "n of C5 ep^n").optional(),
         real("least_rate", &P::least_rate, "1/s", range::positive(),
              "plastic strain rate below which the rate has no effect")
             .optional()});
  }
  static constexpr const char* name = "zerilli_armstrong";
  static constexpr const char* summary = "Zerilli-Armstrong: thermally activated flow of fcc and bcc metals";
  static constexpr const char* theory =
      "Y = C0 + (C1 + C2 sqrt(ep)) exp[(-C3 + C4 ln rate) T] + C5 ep^n, rate in 1/s,\n"
      "times the solid fraction; shear modulus G times the solid fraction.\n"
      "Source: Zerilli and Armstrong, J. Appl. Phys. 61 (1987) 1816.";

  /// @throws InputError if the constants are inconsistent
  void require_consistent() const {
    if (athermal_stress + thermal_stress <= 0.0) {
      throw InputError("'athermal_stress' or 'thermal_stress' must be positive");
    }
  }
  /// Returns the flow stress at the plastic strain ep0 + x reached in dt, with its derivative with respect to x.
  [[nodiscard]] FlowStress flow(double plastic_strain, double x, double dt, double temperature) const {
    const double strain = plastic_strain + x, rate = x / dt;
    const double T = std::isnan(temperature) ? 300.0 : temperature;
    const bool fast = rate > least_rate;
    const double thermal =
        std::exp((-thermal_coefficient + rate_coefficient * std::log(fast ? rate : least_rate)) * T);
    const double root = std::sqrt(strain),
                 power = hardening_coefficient * std::pow(strain, hardening_exponent);
    const double activated = thermal_stress + thermal_hardening * root;
    FlowStress y{athermal_stress + activated * thermal + power, 0.0};
    if (strain > 0.0) {
      y.slope = 0.5 * thermal_hardening / root * thermal + hardening_exponent * power / strain;
    }
    if (fast) y.slope += activated * thermal * rate_coefficient * T / x;
    return y;
  }
  [[nodiscard]] double flow_stress(double plastic_strain, double rate, double temperature) const {
    constexpr double no_strain = 1e-12;
    return flow(plastic_strain, no_strain, no_strain / std::max(rate, 1e-300), temperature).value;
  }
  [[nodiscard]] double increment(double trial, double plastic_strain, double temperature, double modulus,
                                 double solid, double dt) const {
    // Y increases with strain and rate
    const double least = flow(plastic_strain, 0.0, dt, temperature).value;
    return radial_return(trial, modulus, solid, least,
                         [&](double x) { return flow(plastic_strain, x, dt, temperature); });
  }
};

using ZerilliArmstrongModel = FlowLawModel<ZerilliArmstrong>;

}  // namespace whipple::strength

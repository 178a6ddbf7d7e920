// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/flow_law_model.hpp"
#include "src/material/strength/law_formulas.hpp"

namespace whipple::strength {

/// Johnson-Cook flow stress
///   Y = (A + B ep^n) (1 + C ln max(1, rate / rate_0)) (1 - T*^m),   T* = (T - T_r) / (T_m - T_r) in [0, 1].
/// The rate factor is 1 below the reference rate: the logarithm would otherwise soften slow flow without
/// bound. T_m is the melting temperature of the fit (0.1 MPa): under shock pressure the model loses its
/// strength before the equation of state melts. Source: G. R. Johnson, W. H. Cook, Proc. 7th Int. Symp.
/// Ballistics, The Hague (1983) 541-547.
struct JohnsonCook : ElasticConstants {
  double yield_stress = 0.0;           ///< A, Pa
  double hardening_coefficient = 0.0;  ///< B, Pa
  double hardening_exponent = 1.0;     ///< n
  double rate_coefficient = 0.0;       ///< C
  double reference_rate = 1.0;         ///< 1/s
  double thermal_exponent = 1.0;       ///< m
  double reference_temperature = 0.0;  ///< T_r, K
  double melting_temperature = 0.0;    ///< T_m, K

  static ParameterTable<JohnsonCook> parameters() {
    using P = JohnsonCook;
    return ElasticConstants::parameters<P>(
        {real("yield_stress", &P::yield_stress, "Pa", range::positive(), "A"),
         real("hardening_coefficient", &P::hardening_coefficient, "Pa", range::non_negative(), "B"),
         real("hardening_exponent", &P::hardening_exponent, "", range::positive(), "n"),
         real("rate_coefficient", &P::rate_coefficient, "", range::non_negative(), "C"),
         real("reference_rate", &P::reference_rate, "1/s", range::positive(),
              "plastic strain rate at and below which the rate factor is 1")
             .optional(),
         real("thermal_exponent", &P::thermal_exponent, "", range::positive(), "m"),
         real("reference_temperature", &P::reference_temperature, "K", range::positive(),
              "T_r: no softening at and below it"),
         real("melting_temperature", &P::melting_temperature, "K", range::positive(),
              "T_m: no strength at and above it")});
  }
  static constexpr const char* name = "johnson_cook";
  static constexpr const char* summary = "Johnson-Cook: hardening, strain rate and thermal softening";
  static constexpr const char* theory =
      "Y = (A + B ep^n) (1 + C ln max(1, rate/reference_rate)) (1 - T*^m), T* = (T - T_r)/(T_m - T_r) in [0, "
      "1],\n"
      "times the solid fraction; shear modulus G times the solid fraction. The yield condition holds at the "
      "end of the\n"
      "step with its hardening and rate.\n"
      "Source: Johnson and Cook, Proc. 7th Int. Symp. Ballistics (1983) 541-547.";

  /// @throws InputError if the constants are inconsistent
  void require_consistent() const {
    if (melting_temperature <= reference_temperature) {
      throw InputError("'melting_temperature' must be above 'reference_temperature'");
    }
  }
  /// Returns 1 - T*^m; without a temperature (NaN) of the equation of state there is no softening.
  [[nodiscard]] double thermal_factor(double temperature) const {
    return formulas::thermal_softening(*this, temperature);
  }
  [[nodiscard]] double flow_stress(double plastic_strain, double rate, double temperature) const {
    const double hardening =
        hardening_coefficient * std::pow(std::max(plastic_strain, 0.0), hardening_exponent);
    const double rate_factor = 1.0 + rate_coefficient * std::log(std::max(1.0, rate / reference_rate));
    return (yield_stress + hardening) * rate_factor * thermal_factor(temperature);
  }

  /// Returns false if a point remains elastic whatever its hardening: avoids the powers for most elastic points.
  [[nodiscard]] bool may_yield(double trial, double temperature, double /*modulus*/, double solid) const {
    const double per_span = 1.0 / (melting_temperature - reference_temperature);  // equal for all points
    const double homologous = (temperature - reference_temperature) * per_span;
    // T*^m <= T* for m >= 1
    const double least = thermal_exponent >= 1.0 ? std::max(1.0 - homologous, 0.0) : 0.0;
    return trial > solid * yield_stress * (homologous > 0.0 ? least : 1.0);
  }
  /// Solves for the increments (BatchLaw).
  void solve(YieldingPoints& points, double dt) const;
  [[nodiscard]] double increment(double trial, double plastic_strain, double temperature, double modulus,
                                 double solid, double dt) const {
    return increment_of_one(*this, trial, plastic_strain, temperature, modulus, solid, dt);
  }
};

using JohnsonCookModel = FlowLawModel<JohnsonCook>;

}  // namespace whipple::strength

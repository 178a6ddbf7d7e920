// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/base/parameter_table.hpp"
#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/flow_law_model.hpp"
#include "src/material/strength/radial_return.hpp"

namespace whipple::strength {

/// Power-law isotropic hardening, Y = A + B ep^n, independent of rate and temperature. Source: P. Ludwik,
/// Elemente der technologischen Mechanik (Springer 1909).
struct PowerLaw : ElasticConstants {
  double yield_stress = 0.0;           ///< A, Pa
  double hardening_coefficient = 0.0;  ///< B, Pa
  double hardening_exponent = 1.0;     ///< n

  static ParameterTable<PowerLaw> parameters() {
    using P = PowerLaw;
    ParameterTable<P> table = ElasticConstants::parameters<P>();
    table.push_back(real("yield_stress", &P::yield_stress, "Pa", range::positive(), "A"));
    table.push_back(
        real("hardening_coefficient", &P::hardening_coefficient, "Pa", range::non_negative(), "B"));
    table.push_back(real("hardening_exponent", &P::hardening_exponent, "", range::positive(), "n"));
    return table;
  }
  static constexpr const char* name = "power_law";
  static constexpr const char* summary = "von Mises plasticity with power-law isotropic hardening";
  static constexpr const char* theory =
      "Y = A + B ep^n, times the solid fraction; shear modulus G times the solid fraction.\n"
      "Source: Ludwik, Elemente der technologischen Mechanik (1909).";

  [[nodiscard]] FlowStress flow(double strain) const {
    if (strain <= 0.0) return {yield_stress, 0.0};
    const double power = hardening_coefficient * std::pow(strain, hardening_exponent);
    return {yield_stress + power, hardening_exponent * power / strain};
  }
  [[nodiscard]] double flow_stress(double strain, double /*rate*/, double /*temperature*/) const {
    return flow(strain).value;
  }
  [[nodiscard]] double increment(double trial, double strain, double /*temperature*/, double modulus,
                                 double solid, double /*dt*/) const {
    return radial_return(trial, modulus, solid, flow(strain).value,
                         [&](double x) { return flow(strain + x); });
  }
  void require_consistent() const {}  // the ranges of the constants say it all
};

using PowerLawModel = FlowLawModel<PowerLaw>;

}  // namespace whipple::strength

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/base/parameter_table.hpp"
#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/flow_law_model.hpp"
#include "src/material/strength/radial_return.hpp"

namespace whipple::strength {

/// Isotropic hardening that saturates, Y = A + Q1 [1 - exp(-b1 ep)] + Q2 [1 - exp(-b2 ep)], independent of
/// rate and temperature. Source: E. Voce, J. Inst. Metals 74 (1948) 537; two terms as in F. Grytten et al.,
/// Int. J. Impact Eng. 36 (2009) 416.
struct Voce : ElasticConstants {
  double yield_stress = 0.0;                          ///< A, Pa
  double first_saturation = 0.0, first_rate = 0.0;    ///< Q1, Pa; b1
  double second_saturation = 0.0, second_rate = 0.0;  ///< Q2, Pa; b2

  static ParameterTable<Voce> parameters() {
    using P = Voce;
    ParameterTable<P> table = ElasticConstants::parameters<P>();
    table.push_back(real("yield_stress", &P::yield_stress, "Pa", range::positive(), "A"));
    table.push_back(real("first_saturation", &P::first_saturation, "Pa", range::non_negative(), "Q1"));
    table.push_back(real("first_rate", &P::first_rate, "", range::non_negative(), "b1"));
    table.push_back(
        real("second_saturation", &P::second_saturation, "Pa", range::non_negative(), "Q2").optional());
    table.push_back(real("second_rate", &P::second_rate, "", range::non_negative(), "b2").optional());
    return table;
  }
  static constexpr const char* name = "voce";
  static constexpr const char* summary = "von Mises plasticity with saturating isotropic hardening";
  static constexpr const char* theory =
      "Y = A + Q1 [1 - exp(-b1 ep)] + Q2 [1 - exp(-b2 ep)], times the solid fraction; shear modulus G times\n"
      "the solid fraction. Source: Voce, J. Inst. Metals 74 (1948) 537.";

  [[nodiscard]] FlowStress flow(double strain) const {
    const double first = first_saturation * std::exp(-first_rate * strain);
    const double second = second_saturation * std::exp(-second_rate * strain);
    return {yield_stress + first_saturation - first + second_saturation - second,
            first_rate * first + second_rate * second};
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

using VoceModel = FlowLawModel<Voce>;

}  // namespace whipple::strength

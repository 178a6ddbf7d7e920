// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "src/core/base/error.hpp"
#include "src/material/strength/hardening_law.hpp"
#include "src/material/strength/law_formulas.hpp"
#include "src/material/strength/return_slopes.hpp"

namespace whipple::strength {

/// Linear hardening: Y(ep) = min(A + B ep, Y_max), independent of rate and temperature. The return has a closed form: x
/// = (q - w Y(ep)) / (3 G + w B), or (q - w Y_max) / (3 G) on the plateau. Source: M. L. Wilkins, Calculation of
/// elastic-plastic flow, UCRL-7322 (1963); radial return with hardening: J. C. Simo, T. J. R. Hughes, Computational
/// Inelasticity (Springer 1998), box 3.1.
struct VonMises : HardeningLaw<VonMises> {
  double hardening_modulus = 0.0;                                        ///< B, Pa
  double maximum_flow_stress = std::numeric_limits<double>::infinity();  ///< Y_max, Pa

  static ParameterTable<VonMises> parameters() {
    using P = VonMises;
    return HardeningLaw::parameters(
        {real("hardening_modulus", &P::hardening_modulus, "Pa", range::non_negative(),
              "slope B of the flow stress over equivalent plastic strain")
             .optional(),
         real("maximum_flow_stress", &P::maximum_flow_stress, "Pa", range::positive(),
              "upper bound Y_max of the flow stress")
             .optional()});
  }
  static constexpr const char* name = "von_mises";
  static constexpr const char* summary = "von Mises plasticity with linear hardening";
  static constexpr const char* theory =
      "sqrt(3/2 (s - a):(s - a)) = Y = min(A + B ep, Y_max), back stress da = 2/3 H d(plastic strain); Y, H "
      "and\n"
      "shear modulus G times the solid fraction.\n"
      "Source: Wilkins, UCRL-7322 (1963); Simo and Hughes, Computational Inelasticity (1998), box 3.1; "
      "Prager,\n"
      "Proc. Inst. Mech. Eng. 169 (1955) 41.";

  /// @throws InputError if the constants are inconsistent
  void require_consistent() const {
    if (maximum_flow_stress < yield_stress) {
      throw InputError("'maximum_flow_stress' is less than 'yield_stress'");
    }
  }
  [[nodiscard]] FlowStress flow(double strain) const { return formulas::linear_hardening(*this, strain); }

  /// Returns the increment of the equivalent plastic strain from the equivalent trial stress.
  [[nodiscard]] double increment(double trial, double plastic_strain, double /*temperature*/, double modulus,
                                 double solid, double /*dt*/) const {
    return formulas::linear_return(*this, trial, plastic_strain, modulus, solid);
  }
  /// Returns dY/dq = w B/(3 G + w B) while it hardens, 0 on the plateau.
  [[nodiscard]] ReturnSlopes slopes(const ReturnedPoint& point) const {
    if (!point.flows) return {};
    const double hardening = point.factor * hardening_modulus, stiffness = 3.0 * point.modulus + hardening;
    const double yield = point.factor * formulas::linear_hardening(*this, point.plastic_strain).value;
    const double hardened = yield + hardening * (point.trial - yield) / stiffness;
    return {.stress_by_trial = hardened < point.factor * maximum_flow_stress ? hardening / stiffness : 0.0};
  }
};

using VonMisesModel = FlowLawModel<VonMises>;

}  // namespace whipple::strength

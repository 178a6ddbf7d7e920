// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "src/material/strength/hardening_law.hpp"

namespace whipple::strength {

/// Saturating isotropic hardening, Y = A + Q1 [1 - exp(-b1 ep)] + Q2 [1 - exp(-b2 ep)], independent of rate and
/// temperature. Source: E. Voce, J. Inst. Metals 74 (1948) 537; two terms as in F. Grytten et al., Int. J. Impact Eng.
/// 36 (2009) 416.
struct Voce : HardeningLaw<Voce> {
  double first_saturation = 0.0, first_rate = 0.0;    ///< Q1, Pa; b1
  double second_saturation = 0.0, second_rate = 0.0;  ///< Q2, Pa; b2

  static ParameterTable<Voce> parameters() {
    using P = Voce;
    return HardeningLaw::parameters(
        {real("first_saturation", &P::first_saturation, "Pa", range::non_negative(), "Q1"),
         real("first_rate", &P::first_rate, "", range::non_negative(), "b1"),
         real("second_saturation", &P::second_saturation, "Pa", range::non_negative(), "Q2").optional(),
         real("second_rate", &P::second_rate, "", range::non_negative(), "b2").optional()});
  }
  static constexpr const char* name = "voce";
  static constexpr const char* summary = "von Mises plasticity with hardening that saturates";
  static constexpr const char* theory =
      "sqrt(3/2 (s - a):(s - a)) = Y = A + Q1 [1 - exp(-b1 ep)] + Q2 [1 - exp(-b2 ep)], back stress\n"
      "da = 2/3 H d(plastic strain); Y, H and shear modulus G times the solid fraction.\n"
      "Source: Voce, J. Inst. Metals 74 (1948) 537; Prager, Proc. Inst. Mech. Eng. 169 (1955) 41.";

  [[nodiscard]] FlowStress flow(double strain) const {
    const double first = first_saturation * std::exp(-first_rate * strain);
    const double second = second_saturation * std::exp(-second_rate * strain);
    return {yield_stress + first_saturation - first + second_saturation - second,
            first_rate * first + second_rate * second};
  }
};

using VoceModel = FlowLawModel<Voce>;

}  // namespace whipple::strength

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "src/material/strength/hardening_law.hpp"

namespace whipple::strength {

/// Power-law isotropic hardening, Y = A + B ep^n, independent of rate and temperature. Source: P. Ludwik,
/// Elemente der technologischen Mechanik (Springer 1909).
struct PowerLaw : HardeningLaw<PowerLaw> {
  double hardening_coefficient = 0.0;  ///< B, Pa
  double hardening_exponent = 1.0;     ///< n

  static ParameterTable<PowerLaw> parameters() {
    using P = PowerLaw;
    return HardeningLaw::parameters(
        {real("hardening_coefficient", &P::hardening_coefficient, "Pa", range::non_negative(), "B"),
         real("hardening_exponent", &P::hardening_exponent, "", range::positive(), "n")});
  }
  static constexpr const char* name = "power_law";
  static constexpr const char* summary = "von Mises plasticity with power-law hardening";
  static constexpr const char* theory =
      "sqrt(3/2 (s - a):(s - a)) = Y = A + B ep^n, back stress da = 2/3 H d(plastic strain); Y, H and shear\n"
      "modulus G times the solid fraction.\n"
      "Source: Ludwik, Elemente der technologischen Mechanik (1909); Prager, Proc. Inst. Mech. Eng. 169 "
      "(1955) "
      "41.";

  [[nodiscard]] FlowStress flow(double strain) const {
    if (strain <= 0.0) return {yield_stress, 0.0};
    const double power = hardening_coefficient * std::pow(strain, hardening_exponent);
    return {yield_stress + power, hardening_exponent * power / strain};
  }
};

using PowerLawModel = FlowLawModel<PowerLaw>;

}  // namespace whipple::strength

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/failure/criterion.hpp"
#include "src/material/principal.hpp"

namespace whipple::failure {

/// Brittle failure by the largest principal stress (Rankine's hypothesis): a point fails where
///   s_1 - p > sigma_f (1 - f) k,
/// s_1 largest principal value of the deviator, f melted fraction, k scatter of the threshold. Source: W. J.
/// M. Rankine, A Manual of Applied Mechanics (1858); the linear loss with melting is this project's choice.
struct PrincipalStress : Threshold {
  double tensile_strength = 0.0;  ///< sigma_f, Pa

  static ParameterTable<PrincipalStress> parameters() {
    return {real("tensile_strength", &PrincipalStress::tensile_strength, "Pa", range::non_negative(),
                 "largest principal stress sigma_f of the solid")};
  }
  static constexpr const char* name = "principal_stress";
  static constexpr Code code = failure::principal_stress;
  static constexpr const char* cause = "principal stress";
  static constexpr const char* summary = "brittle failure: largest principal stress beyond the strength";
  static constexpr const char* theory =
      "Fails (code 3) where the largest principal stress s_1 - p exceeds tensile_strength (1 - melted\n"
      "fraction) * scatter factor. Source: Rankine, A Manual of Applied Mechanics (1858); linear loss with\n"
      "melting: own choice.";

  void mark(const State& state, std::span<double> /*damage*/, std::span<std::uint8_t> failed) const {
    for (std::size_t i = 0; i < failed.size(); ++i) {
      const double limit =
          tensile_strength * (1.0 - state.melted_fraction[i]) * state.threshold_factor[i] + state.pressure[i];
      const SymmetricTensor s = state.deviator[i];
      if (failed[i] != intact || material::greatest_principal_bound(s) <= limit) continue;
      if (material::greatest_principal_value(s) > limit) failed[i] = principal_stress;
    }
  }
};

}  // namespace whipple::failure

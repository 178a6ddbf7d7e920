// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/failure/criterion.hpp"
#include "src/material/principal.hpp"

namespace whipple::failure {

/// Failure by the largest principal strain (Saint-Venant's hypothesis): a point fails where the largest
/// principal value of its logarithmic strain exceeds eps_f k. The strain is the sum of the increments of the
/// steps, rotated with the material (docs/theory/material.md, eq. 17); elastic and plastic parts count alike, so
/// the limit is a value for the loading path at hand.
struct PrincipalStrain : Threshold {
  static constexpr bool needs_strain = true;
  double failure_strain = 0.0;  ///< eps_f

  static ParameterTable<PrincipalStrain> parameters() {
    return {real("failure_strain", &PrincipalStrain::failure_strain, "", range::positive(),
                 "largest principal logarithmic strain eps_f at failure")};
  }
  static constexpr const char* name = "principal_strain";
  static constexpr Code code = failure::principal_strain;
  static constexpr const char* cause = "principal strain";
  static constexpr const char* summary = "failure: largest principal strain beyond a limit";
  static constexpr const char* theory =
      "Fails (code 4) where the largest principal value of the logarithmic strain (sum of the increments,\n"
      "rotated with the material; elastic and plastic) exceeds failure_strain * scatter factor.\n"
      "Source: Barre de Saint-Venant's hypothesis; S. P. Timoshenko, History of Strength of Materials "
      "(1953).";

  void mark(const State& state, std::span<double> /*damage*/, std::span<std::uint8_t> failed) const {
    for (std::size_t i = 0; i < failed.size(); ++i) {
      if (failed[i] != intact) continue;
      SymmetricTensor strain = state.strain[i];
      const double mean = (strain.xx + strain.yy + strain.zz) / 3.0;
      strain.xx -= mean;
      strain.yy -= mean;
      strain.zz -= mean;
      const double limit = failure_strain * state.threshold_factor[i] - mean;
      if (material::greatest_principal_bound(strain) <= limit) continue;
      if (material::greatest_principal_value(strain) > limit) failed[i] = principal_strain;
    }
  }
};

}  // namespace whipple::failure

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/failure/criterion.hpp"

namespace whipple::failure {

/// Ductile failure by accumulated equivalent plastic strain: a point fails where ep > ep_f k, with the
/// scatter k of the threshold. It does not depend on pressure or rate; the limit is a value for the loading
/// path at hand. Source: the failure strain of public debris-cloud inputs (MPM3D-F90,
/// Data/LeadHypervelocityImpact.mpm: 3.0).
struct PlasticStrain : Threshold {
  double failure_strain = 0.0;  ///< ep_f

  static ParameterTable<PlasticStrain> parameters() {
    return {real("failure_strain", &PlasticStrain::failure_strain, "", range::positive(),
                 "equivalent plastic strain at failure")};
  }
  static constexpr const char* name = "plastic_strain";
  static constexpr Code code = plastic;
  static constexpr const char* cause = "plastic strain";
  static constexpr const char* summary = "ductile failure: equivalent plastic strain beyond a limit";
  static constexpr const char* theory =
      "Fails (code 2) where the equivalent plastic strain exceeds failure_strain * scatter factor.";

  void mark(const State& state, std::span<double> /*damage*/, std::span<std::uint8_t> failed) const {
    for (std::size_t i = 0; i < failed.size(); ++i) {
      const double limit = failure_strain * state.threshold_factor[i];
      if (failed[i] == intact && state.plastic_strain[i] > limit) failed[i] = plastic;
    }
  }
};

}  // namespace whipple::failure

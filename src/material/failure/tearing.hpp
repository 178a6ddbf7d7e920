// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/material/failure/criterion.hpp"

namespace whipple::failure {

/// Ductile failure with an energy per area: beyond a limit of the plastic strain the stress decreases in proportion to
/// the opening of the band in which the strain is localised, one cell wide, only in tension (docs/theory/material.md,
/// eq. 19a).
struct Tearing : Threshold {
  static constexpr bool accumulates = true;
  static constexpr bool softens = true;
  /// Damage that counts as complete: beyond it the stress between the cracks cannot be computed.
  static constexpr double complete = 0.999;

  double failure_strain = 0.0;   ///< ep_f
  double energy_per_area = 0.0;  ///< Gamma, J/m^2

  static ParameterTable<Tearing> parameters() {
    return {real("failure_strain", &Tearing::failure_strain, "", range::positive(),
                 "equivalent plastic strain from which damage grows"),
            real("energy_per_area", &Tearing::energy_per_area, "J/m^2", range::positive(),
                 "work from there to the separated faces, per area of the crack")};
  }
  static constexpr const char* name = "tearing";
  static constexpr Code code = plastic;
  static constexpr const char* cause = "plastic strain";
  static constexpr const char* summary = "ductile failure that takes an energy per area of the crack";
  static constexpr const char* theory =
      "Where the equivalent plastic strain exceeds failure_strain * scatter factor and p < 0,\n"
      "dD = Y h dep/(2 energy_per_area): Y the flow stress, h the width of the band, a cell; tension and\n"
      "deviator are multiplied by 1 - D; failed (code 2) at D = 0.999.";

  void mark(const State& state, std::span<double> damage, std::span<std::uint8_t> failed) const {
    for (std::size_t i = 0; i < failed.size(); ++i) {
      const double beyond = state.plastic_strain[i] - failure_strain * state.threshold_factor[i];
      const double increment = std::min(state.plastic_increment[i], beyond);
      if (failed[i] != intact || !(increment > 0.0) || !(state.pressure[i] < 0.0)) continue;
      const SymmetricTensor s = state.deviator[i];
      const double flow_stress = std::sqrt(1.5 * s.squared_norm()) / (1.0 - damage[i]);
      damage[i] = std::min(1.0, damage[i] + 0.5 * flow_stress * state.band[i] * increment / energy_per_area);
      if (damage[i] < complete) continue;
      damage[i] = 1.0;
      failed[i] = plastic;
    }
  }
};

}  // namespace whipple::failure

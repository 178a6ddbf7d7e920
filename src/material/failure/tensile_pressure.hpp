// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/failure/criterion.hpp"

namespace whipple::failure {

/// Spall by tensile pressure: a point fails where p < -p_cut (1 - f) k, with the melted fraction f and the
/// scatter k of the threshold. The tensile strength vanishes with the solid, so fully melted matter fails as
/// soon as its pressure is negative: it parts into drops and becomes free liquid. Source: D. R. Curran, L.
/// Seaman, D. A. Shockey, Dynamic failure of solids, Phys. Rep. 147 (1987) 253-388, of which the constant
/// spall strength is the simplest form; the linear loss with melting is this project's choice.
struct TensilePressure : Threshold {
  double spall_strength = 0.0;  ///< p_cut, Pa

  static ParameterTable<TensilePressure> parameters() {
    return {real("spall_strength", &TensilePressure::spall_strength, "Pa", range::non_negative(),
                 "tensile pressure p_cut at which the solid parts")};
  }
  static constexpr const char* name = "tensile_pressure";
  static constexpr const char* summary = "spall: tensile pressure beyond the spall strength";
  static constexpr const char* theory =
      "Fails (code 1) where p < -spall_strength (1 - melted fraction) * scatter factor; melted matter where "
      "p < 0.\n"
      "Source: Curran, Seaman and Shockey, Phys. Rep. 147 (1987) 253 (constant spall strength; linear loss "
      "with melting: own choice).";

  void mark(const State& state, std::span<double> /*damage*/, std::span<std::uint8_t> failed) const {
    for (std::size_t i = 0; i < failed.size(); ++i) {
      const double strength = spall_strength * (1.0 - state.melted_fraction[i]) * state.threshold_factor[i];
      if (failed[i] == intact && state.pressure[i] < -strength) failed[i] = tensile;
    }
  }
};

}  // namespace whipple::failure

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "src/material/failure/criterion.hpp"
#include "src/material/principal.hpp"

namespace whipple::failure {

/// Selects the tension that accumulates.
enum class Tension : std::uint8_t { principal_stress, mean_stress };
constexpr std::array<Word<Tension>, 2> words(Tension) {
  return {{{Tension::principal_stress, "principal_stress"}, {Tension::mean_stress, "mean_stress"}}};
}

/// Spall by accumulated tension: a point fails (code 8) where
///   integral of (sigma/sigma_0 - 1)^lambda dt = tau,  sigma > sigma_0,
/// the criterion integral of (sigma - sigma_0)^lambda dt = K of the source with K = sigma_0^lambda tau (Pa^lambda s):
/// under a constant tension of 2 sigma_0 failure takes the time tau. sigma is the largest principal stress, the stress
/// across the spall plane of the source, or the mean stress -p (both objective). sigma_0 is multiplied by the solid
/// fraction and by the scatter of the threshold; fully melted material fails where p < 0 (code 1). The damage is the
/// integral over tau and has no effect before it is complete. With `healing` a failed point is intact again, without
/// damage and deviator, once pressure has closed its void. Source: F. R. Tuler, B. M. Butcher, Int. J. Fract. Mech. 4
/// (1968) 431-437.
struct TulerButcher {
  static constexpr bool accumulates = true;
  static constexpr bool softens = false;
  static constexpr bool needs_strain = false;

  double threshold = 0.0;  ///< sigma_0, Pa
  double exponent = 2.0;   ///< lambda
  double time = 0.0;       ///< tau, s
  Tension measure = Tension::principal_stress;
  bool healing = false;

  static ParameterTable<TulerButcher> parameters() {
    using P = TulerButcher;
    return {
        real("threshold", &P::threshold, "Pa", range::positive(),
             "sigma_0: tension below which nothing accumulates"),
        real("exponent", &P::exponent, "", range::positive(), "lambda").optional(),
        real("time", &P::time, "s", range::positive(),
             "tau = K/sigma_0^lambda: time to failure under twice the threshold"),
        choice("measure", &P::measure, "the tension sigma: the largest principal stress or -p").optional(),
        boolean("healing", &P::healing, "points whose void pressure has closed are whole again").optional()};
  }
  static constexpr const char* name = "tuler_butcher";
  static constexpr Code code = spalled;
  static constexpr const char* cause = "accumulated tension";
  static constexpr const char* summary = "spall: tension accumulated over time (Tuler-Butcher)";
  static constexpr const char* theory =
      "Fails (code 8) where the integral of (sigma/sigma_0 - 1)^exponent dt over sigma > sigma_0 reaches "
      "time;\n"
      "sigma_0 = threshold (1 - melted fraction) * scatter factor, sigma the largest principal stress or "
      "-p;\n"
      "melted material fails (code 1) where p < 0. Constants K of the literature: time = "
      "K/threshold^exponent.\n"
      "Source: Tuler and Butcher, Int. J. Fract. Mech. 4 (1968) 431.";
  void require_consistent() const {}  // ensured by the ranges of the constants

  [[nodiscard]] Code healing_code() const { return healing ? spalled : intact; }

  void mark(const State& state, std::span<double> damage, std::span<std::uint8_t> failed) const {
    const bool principal = measure == Tension::principal_stress;
    for (std::size_t i = 0; i < failed.size(); ++i) {
      if (failed[i] != intact) continue;
      const double pressure = state.pressure[i];
      const double least = threshold * (1.0 - state.melted_fraction[i]) * state.threshold_factor[i];
      if (!(least > 0.0)) {
        if (pressure < 0.0) failed[i] = tensile;
        continue;
      }
      double tension = -pressure;
      if (principal) {
        const SymmetricTensor s = state.deviator[i];
        if (material::greatest_principal_bound(s) - pressure <= least) continue;
        tension += material::greatest_principal_value(s);
      }
      if (tension <= least) continue;
      const double rate = std::pow(tension / least - 1.0, exponent) / time;
      damage[i] = std::min(1.0, damage[i] + rate * state.time_step);
      if (damage[i] >= 1.0) failed[i] = spalled;
    }
  }
};

}  // namespace whipple::failure

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/base/error.hpp"
#include "src/material/failure/criterion.hpp"

namespace whipple::failure {

/// Ductile fracture by accumulated damage: dD = dep / (eps_f k), failed at D = 1, with
///   eps_f = [D1 + D2 exp(D3 t)] [1 + D4 ln max(1, rate/rate_0)] [1 + D5 T*],
///   t = sigma_m / sigma_eq (mean over equivalent stress, tension positive), T* = (T - T_r)/(T_m - T_r) in
/// [0, 1], k the scatter of the threshold. The tests behind the constants reach t = 1.5; beyond, t is taken
/// as 1.5. Several published sets make eps_f negative below that: `least_failure_strain` bounds it. Source:
/// G. R. Johnson, W. H. Cook, Eng. Fract. Mech. 21 (1985) 31-48, eq. 3 to 5.
struct JohnsonCookDamage {
  static constexpr bool accumulates = true;
  static constexpr bool softens = false;
  static constexpr bool needs_strain = false;
  static constexpr double greatest_triaxiality = 1.5;

  double d1 = 0.0, d2 = 0.0, d3 = 0.0, d4 = 0.0, d5 = 0.0;
  double reference_rate = 1.0;         ///< rate_0, 1/s
  double reference_temperature = 0.0;  ///< T_r, K
  double melting_temperature = 0.0;    ///< T_m, K
  double least_failure_strain = 1e-3;

  static ParameterTable<JohnsonCookDamage> parameters() {
    using P = JohnsonCookDamage;
    return {real("d1", &P::d1, "", range::any(), "D1"),
            real("d2", &P::d2, "", range::any(), "D2"),
            real("d3", &P::d3, "", range::any(), "D3, of the triaxiality (negative: tension breaks)"),
            real("d4", &P::d4, "", range::any(), "D4, of the rate"),
            real("d5", &P::d5, "", range::any(), "D5, of the temperature"),
            real("reference_rate", &P::reference_rate, "1/s", range::positive(),
                 "plastic strain rate at and below which the rate factor is 1")
                .optional(),
            real("reference_temperature", &P::reference_temperature, "K", range::positive(),
                 "T_r: T* is 0 at and below it"),
            real("melting_temperature", &P::melting_temperature, "K", range::positive(),
                 "T_m: T* is 1 at and above it"),
            real("least_failure_strain", &P::least_failure_strain, "", range::positive(),
                 "lower bound of the failure strain")
                .optional()};
  }
  static constexpr const char* name = "johnson_cook_damage";
  static constexpr const char* summary =
      "ductile fracture: damage by plastic strain, triaxiality, rate and temperature (Johnson-Cook)";
  static constexpr const char* theory =
      "dD = dep / (eps_f * scatter factor), fails (code 5) at D = 1, where\n"
      "eps_f = (d1 + d2 exp(d3 t)) (1 + d4 ln max(1, rate/reference_rate)) (1 + d5 T*), at least\n"
      "least_failure_strain; t = -p/sqrt(3/2 s:s), at most 1.5; T* = (T - T_r)/(T_m - T_r) in [0, 1].\n"
      "Source: Johnson and Cook, Eng. Fract. Mech. 21 (1985) 31-48.";

  /// @throws InputError if the constants contradict one another
  void require_consistent() const {
    if (melting_temperature <= reference_temperature) {
      throw InputError("'melting_temperature' must be above 'reference_temperature'");
    }
  }
  /// eps_f. An equation of state without temperature (NaN) counts as cold.
  [[nodiscard]] double failure_strain(double triaxiality, double rate, double temperature) const {
    constexpr double greatest_exponent = 100.0;  // strong compression: no damage, and no overflow
    const double shape =
        d1 + d2 * std::exp(std::min(d3 * std::min(triaxiality, greatest_triaxiality), greatest_exponent));
    const double fast = 1.0 + d4 * std::log(std::max(1.0, rate / reference_rate));
    const double homologous =
        (temperature - reference_temperature) / (melting_temperature - reference_temperature);
    const double hot = 1.0 + d5 * (homologous > 0.0 ? std::min(homologous, 1.0) : 0.0);
    return std::max(shape * fast * hot, least_failure_strain);
  }
  void mark(const State& state, std::span<double> damage, std::span<std::uint8_t> failed) const {
    for (std::size_t i = 0; i < failed.size(); ++i) {
      const double increment = state.plastic_increment[i];
      if (failed[i] != intact || !(increment > 0.0)) continue;
      const double equivalent = std::sqrt(1.5 * state.deviator[i].squared_norm());
      if (!(equivalent > 0.0)) continue;  // no solid left
      const double limit =
          failure_strain(-state.pressure[i] / equivalent, increment / state.time_step, state.temperature[i]);
      damage[i] = std::min(1.0, damage[i] + increment / (limit * state.threshold_factor[i]));
      if (damage[i] >= 1.0) failed[i] = fractured;
    }
  }
};

}  // namespace whipple::failure

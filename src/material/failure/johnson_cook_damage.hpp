// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/core/base/error.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/material/failure/criterion.hpp"
#include "src/material/failure/fracture_formulas.hpp"

namespace whipple::failure {

/// Ductile fracture by accumulated damage: dD = dep / (eps_f k), failed at D = 1, with
///   eps_f = [D1 + D2 exp(D3 t)] [1 + D4 ln max(1, rate/rate_0)] [1 + D5 T*],
///   t = sigma_m / sigma_eq (mean over equivalent stress, tension positive), T* = (T - T_r)/(T_m - T_r) in [0, 1],
/// k the scatter of the threshold. The tests behind the constants extend to t = 1.5, beyond which t is held constant.
/// Several published sets give a negative eps_f below that: `least_failure_strain` is its lower bound. Plastic strain
/// causes no damage outside of `least_triaxiality` and `greatest_triaxiality`: there is no fracture in compression
/// beyond that of upsetting, t = -1/3 (Y. Bao, T. Wierzbicki, Eng. Fract. Mech. 72 (2005) 1049), and in strong tension
/// voids grow, for which there is a separate criterion. Source: G. R. Johnson, W. H. Cook, Eng. Fract. Mech. 21 (1985)
/// 31-48, eq. 3 to 5.
struct JohnsonCookDamage {
  static constexpr bool accumulates = true;
  static constexpr bool softens = false;
  static constexpr bool needs_strain = false;

  double d1 = 0.0, d2 = 0.0, d3 = 0.0, d4 = 0.0, d5 = 0.0;
  double reference_rate = 1.0;         ///< rate_0, 1/s
  double reference_temperature = 0.0;  ///< T_r, K
  double melting_temperature = 0.0;    ///< T_m, K
  double least_failure_strain = 1e-3;
  double least_triaxiality = -std::numeric_limits<double>::infinity();
  double greatest_triaxiality = std::numeric_limits<double>::infinity();

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
                .optional(),
            real("least_triaxiality", &P::least_triaxiality, "", range::any(),
                 "below it, in compression, plastic strain does no damage")
                .optional(),
            real("greatest_triaxiality", &P::greatest_triaxiality, "", range::any(),
                 "above it plastic strain does no damage: a criterion of tension has its place")
                .optional()};
  }
  static constexpr const char* name = "johnson_cook_damage";
  static constexpr Code code = fractured;
  static constexpr const char* cause = "ductile damage";
  static constexpr const char* summary =
      "ductile fracture: damage by plastic strain, triaxiality, rate and temperature (Johnson-Cook)";
  static constexpr const char* theory =
      "dD = dep / (eps_f * scatter factor), fails (code 5) at D = 1, where\n"
      "eps_f = (d1 + d2 exp(d3 t)) (1 + d4 ln max(1, rate/reference_rate)) (1 + d5 T*), at least\n"
      "least_failure_strain; t = -p/sqrt(3/2 s:s), at most 1.5; no damage outside of\n"
      "least_triaxiality <= t <= greatest_triaxiality; T* = (T - T_r)/(T_m - T_r) in [0, 1].\n"
      "Source: Johnson and Cook, Eng. Fract. Mech. 21 (1985) 31-48.";

  /// @throws InputError if the constants are inconsistent
  void require_consistent() const {
    if (!(least_triaxiality < greatest_triaxiality)) {
      throw InputError("'least_triaxiality' must be below 'greatest_triaxiality'");
    }
    if (melting_temperature <= reference_temperature) {
      throw InputError("'melting_temperature' must be above 'reference_temperature'");
    }
  }
  /// Returns eps_f. Without a temperature (NaN) of the equation of state there is no softening.
  [[nodiscard]] double failure_strain(double triaxiality, double rate, double temperature) const {
    return failure_strain(broadcast(triaxiality), broadcast(rate), broadcast(temperature))[0];
  }
  [[nodiscard]] Lanes failure_strain(Lanes triaxiality, Lanes rate, Lanes temperature) const {
    return formulas::failure_strain(*this, triaxiality, rate, temperature);
  }
  void mark(const State& state, std::span<double> damage, std::span<std::uint8_t> failed) const {
    for (std::size_t i = 0; i < failed.size(); i += 4) {
      const std::size_t count = std::min<std::size_t>(4, failed.size() - i);
      const Lanes increment = load(&state.plastic_increment[i], count, 0.0);
      if (!any(increment > 0.0)) continue;
      Lanes equivalent{};
      for (std::size_t k = 0; k < count; ++k) {
        equivalent[k] = std::sqrt(1.5 * state.deviator[i + k].squared_norm());
      }
      const Lanes triaxiality = -load(&state.pressure[i], count, 0.0) / equivalent;
      const Lanes limit = failure_strain(triaxiality, increment / state.time_step,
                                         load(&state.temperature[i], count, reference_temperature));
      for (std::size_t k = 0; k < count; ++k) {
        // At an equivalent stress of 0 there is no solid.
        if (failed[i + k] != intact || !(increment[k] > 0.0) || !(equivalent[k] > 0.0) ||
            triaxiality[k] < least_triaxiality || triaxiality[k] > greatest_triaxiality) {
          continue;
        }
        damage[i + k] =
            std::min(1.0, damage[i + k] + increment[k] / (limit[k] * state.threshold_factor[i + k]));
        if (damage[i + k] >= 1.0) failed[i + k] = fractured;
      }
    }
  }
};

}  // namespace whipple::failure

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/material/failure/criterion.hpp"

namespace whipple::failure {

/// Growth, nucleation and coalescence of voids in a plastic matrix, with the yield surface
///   g = (Q/Y)^2 + 2 q1 f* cosh(3 q2 P/(2 Y)) - 1 - (q1 f*)^2 = 0
/// of the porous material: Q, P equivalent stress and pressure on material and voids together, Y flow stress of
/// the matrix (of the strength model), f volume fraction of the voids,
///   f* = f for f <= f_c,  f_c + (1/q1 - f_c)(f - f_c)/(f_F - f_c) above;
///   df = (1 - f) d(volumetric plastic strain) + f_N/(s_N sqrt(2 pi)) exp(-((ep - eps_N)/s_N)^2/2) dep,
/// the second in tension only; (1 - f) Y dep is the plastic work. The stress is returned along the normal of
/// g with f and Y of the beginning of the step (N. Aravas, Int. J. Numer. Meth. Eng. 24 (1987) 1395). Failed
/// at f = f_F k, k scatter of the threshold, or when the matrix has melted. Source: A. L. Gurson, J. Eng.
/// Mater. Technol. 99 (1977) 2; V. Tvergaard, A. Needleman, Acta Metall. 32 (1984) 157; nucleation: C. C.
/// Chu, A. Needleman, J. Eng. Mater. Technol. 102 (1980) 249.
struct Gurson {
  static constexpr bool accumulates = true;
  static constexpr bool softens = false;
  static constexpr bool needs_strain = false;
  static constexpr bool returns_deviator = true;

  double q1 = 1.5, q2 = 1.0;
  double initial_porosity = 0.0;    ///< f_0
  double critical_porosity = 1.0;   ///< f_c
  double failure_porosity = 0.0;    ///< f_F
  double nucleated_porosity = 0.0;  ///< f_N
  double nucleation_strain = 0.3;   ///< eps_N
  double nucleation_scatter = 0.1;  ///< s_N

  static ParameterTable<Gurson> parameters() {
    using P = Gurson;
    return {real("q1", &P::q1, "", range::positive(), "q1 of the yield surface").optional(),
            real("q2", &P::q2, "", range::positive(), "q2 of the yield surface").optional(),
            real("initial_porosity", &P::initial_porosity, "",
                 Range{.lower = 0.0, .upper = 1.0, .upper_open = true},
                 "f_0: volume fraction of the voids at the start"),
            real("critical_porosity", &P::critical_porosity, "", range::positive(),
                 "f_c at which voids begin to coalesce (at f_F or above: no coalescence)")
                .optional(),
            real("failure_porosity", &P::failure_porosity, "", range::open_between(0.0, 1.0),
                 "f_F at which the material parts"),
            real("nucleated_porosity", &P::nucleated_porosity, "",
                 Range{.lower = 0.0, .upper = 1.0, .upper_open = true},
                 "f_N: volume fraction of the voids that can nucleate")
                .optional(),
            real("nucleation_strain", &P::nucleation_strain, "", range::any(),
                 "eps_N: mean plastic strain of nucleation")
                .optional(),
            real("nucleation_scatter", &P::nucleation_scatter, "", range::positive(),
                 "s_N: standard deviation of it")
                .optional()};
  }
  static constexpr const char* name = "gurson";
  static constexpr Code code = void_growth;
  static constexpr const char* cause = "growth of voids";
  static constexpr const char* summary =
      "ductile failure: growth, nucleation and coalescence of voids (Gurson, Tvergaard and Needleman)";
  static constexpr const char* theory =
      "Yield surface (Q/Y)^2 + 2 q1 f* cosh(3 q2 P/(2 Y)) - 1 - (q1 f*)^2 = 0 with associated flow, f* = f "
      "up to\n"
      "critical_porosity, then rising to 1/q1 at failure_porosity;\n"
      "df = (1 - f) d(eps_v) + f_N/(s_N sqrt(2 pi)) exp(-((ep - eps_N)/s_N)^2/2) dep; fails (code 7) at\n"
      "f = failure_porosity * scatter factor.\n"
      "Source: Gurson, J. Eng. Mater. Technol. 99 (1977) 2; Tvergaard and Needleman, Acta Metall. 32 (1984) "
      "157;\n"
      "Chu and Needleman, J. Eng. Mater. Technol. 102 (1980) 249.";

  /// @throws InputError if the constants are inconsistent
  void require_consistent() const {
    if (initial_porosity >= failure_porosity) {
      throw InputError("'initial_porosity' must be below 'failure_porosity'");
    }
    if (q1 * effective(failure_porosity) > 1.0 + 1e-12) {
      throw InputError(
          "'failure_porosity' times 'q1' exceeds 1: the material has no strength left before it");
    }
  }
  /// Returns f*.
  [[nodiscard]] double effective(double porosity) const {
    if (porosity <= critical_porosity || critical_porosity >= failure_porosity) return porosity;
    const double acceleration = (1.0 / q1 - critical_porosity) / (failure_porosity - critical_porosity);
    return critical_porosity + acceleration * (porosity - critical_porosity);
  }
  /// Returns g.
  [[nodiscard]] double yield(double equivalent, double pressure, double flow, double porosity) const {
    const double a = q1 * effective(porosity), q = equivalent / flow;
    return q * q + 2.0 * a * std::cosh(1.5 * q2 * pressure / flow) - 1.0 - a * a;
  }

  /// Holds the stress on material and voids together, and the plastic strain increments of a return.
  struct Return {
    double equivalent, pressure;     ///< Pa
    double equivalent_strain = 0.0;  ///< work-conjugate to the equivalent stress
    double volumetric_strain = 0.0;  ///< positive if voids grow
  };
  /// Returns the stress along the normal of the surface from the trial stress. With the pressure P as the unknown, the
  /// normal gives the multiplier lambda = (P_t - P)/(2 K a b sinh(b P)) and Q = Q_t/(1 + 6 G lambda/Y^2); g decreases
  /// monotonically from the trial pressure to P = 0, where it is -(1 - a)^2. Regula falsi (Illinois) between these.
  /// @param bulk, shear  moduli of material and voids together, Pa
  [[nodiscard]] Return return_to_surface(double trial, double trial_pressure, double bulk, double shear,
                                         double flow, double porosity) const {
    const double a = q1 * effective(porosity), b = 1.5 * q2 / flow;
    const auto without_volume = [&] {
      const double q = std::min(trial, (1.0 - a) * flow);
      return Return{q, trial_pressure, (trial - q) / (3.0 * shear)};
    };
    if (!(std::abs(b * trial_pressure) > 1e-9) || !(a > 0.0)) return without_volume();
    const double greatest = std::acosh((1.0 + a * a) / (2.0 * a)) / b;  // where Q vanishes
    double from = std::clamp(trial_pressure, -greatest, greatest), to = 0.0;
    if (yield(trial, from, flow, porosity) <= 0.0 && from == trial_pressure) return {trial, trial_pressure};
    double multiplier = 0.0, q = trial;
    const auto surface = [&](double p) {
      multiplier = (trial_pressure - p) / (2.0 * bulk * a * b * std::sinh(b * p));
      q = trial / (1.0 + 6.0 * shear * multiplier / (flow * flow));
      const double ratio = q / flow;
      return ratio * ratio + 2.0 * a * std::cosh(b * p) - 1.0 - a * a;
    };
    double at_from = surface(from), at_to = -(1.0 - a) * (1.0 - a), p = from;
    for (int iteration = 0; iteration < 100; ++iteration) {
      p = (from * at_to - to * at_from) / (at_to - at_from);
      const double value = surface(p);
      if (std::abs(value) <= 1e-12 || std::abs(to - from) <= 1e-14 * std::abs(trial_pressure)) break;
      if (value > 0.0) {
        from = p;
        at_from = value;
        at_to *= 0.5;
      } else {
        to = p;
        at_to = value;
        at_from *= 0.5;
      }
    }
    return {q, p, 2.0 * multiplier * q / (flow * flow), (p - trial_pressure) / bulk};
  }

  void grow_voids(const PorousState& state, std::span<double> damage, std::span<std::uint8_t> failed) const {
    for (std::size_t i = 0; i < failed.size(); ++i) {
      if (failed[i] != intact) continue;
      const double total = state.volume[i] + state.void_volume[i];
      const double porosity = state.void_volume[i] / total;
      if (porosity == 0.0 && nucleated_porosity == 0.0) continue;
      if (!(state.flow_stress[i] > 0.0)) {  // molten: a spray with its voids
        if (porosity > 0.0) failed[i] = void_growth;
        continue;
      }
      const double share = 1.0 - porosity, old_strain = state.plastic_strain[i] - state.plastic_increment[i];
      const Return r =
          return_to_surface(share * state.trial[i], share * state.pressure[i], share * state.bulk_modulus[i],
                            share * state.shear_modulus[i], state.flow_stress[i], porosity);
      const double increment = (r.equivalent * r.equivalent_strain - r.pressure * r.volumetric_strain) /
                               (share * state.flow_stress[i]);
      double grown = porosity + share * r.volumetric_strain;
      if (r.pressure < 0.0) grown += nucleation_rate(old_strain) * increment;
      constexpr double greatest_step = 0.1;  // fraction of the material's volume
      grown = std::clamp(grown, std::max(0.0, porosity - greatest_step), porosity + greatest_step * share);
      const double volume = total * (1.0 - grown);
      state.pressure[i] += state.bulk_modulus[i] * (state.volume[i] - volume) / state.volume[i];
      state.equivalent[i] = r.equivalent / share;
      state.plastic_increment[i] = increment;
      state.plastic_strain[i] = old_strain + increment;
      state.volume[i] = volume;
      state.void_volume[i] = total - volume;
      damage[i] = std::min(1.0, grown / (failure_porosity * state.threshold_factor[i]));
      if (damage[i] >= 1.0) failed[i] = void_growth;
    }
  }
  /// Returns df/dep of the nucleation.
  [[nodiscard]] double nucleation_rate(double plastic_strain) const {
    const double x = (plastic_strain - nucleation_strain) / nucleation_scatter;
    return nucleated_porosity / (nucleation_scatter * std::sqrt(2.0 * std::numbers::pi)) *
           std::exp(-0.5 * x * x);
  }
};

}  // namespace whipple::failure

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/core/base/error.hpp"
#include "src/material/reaction/reaction.hpp"

namespace whipple::reaction {

/// Ignition and growth (E. L. Lee, C. M. Tarver, Phys. Fluids 23 (1980) 2362, with the two growth terms of C. M.
/// Tarver, J. O. Hallquist, L. M. Erickson, 8th Symp. (Int.) on Detonation (1985) 951), with P = p/p_r and eta =
/// rho/rho0 - 1:
///   dF/dt = I (1 - F)^b (eta - a)^x        while F < F_i and eta > a  (hot spots behind the shock)
///         + G1 (1 - F)^c F^d P^y           while F < F_1              (their growth)
///         + G2 (1 - F)^e F^g P^z           for F >= F_2               (completion)
/// Rates refer to the pressure p_r, by default 100 GPa: those of tables in Mbar and us are then in 1/us as printed.
/// Reactant and products have one pressure and temperature. F advances in steps of at most `largest_step`, each by the
/// midpoint rule, at constant compression and pressure.
struct IgnitionAndGrowth {
  static constexpr Closure closure = Closure::equilibrium;
  static constexpr double largest_step = 0.02;
  static constexpr double nearness = 1e-9;  ///< relative distance from a limit at which a term begins or ends

  double rate_pressure = 1e11;        ///< p_r, Pa
  double ignition_rate = 0.0;         ///< I, 1/s
  double ignition_depletion = 0.0;    ///< b
  double ignition_threshold = 0.0;    ///< a
  double ignition_exponent = 0.0;     ///< x
  double ignition_end = 0.0;          ///< F_i
  double growth_rate = 0.0;           ///< G1, 1/s
  double growth_depletion = 0.0;      ///< c
  double growth_order = 0.0;          ///< d
  double growth_exponent = 0.0;       ///< y
  double growth_end = 0.0;            ///< F_1
  double completion_rate = 0.0;       ///< G2, 1/s
  double completion_depletion = 0.0;  ///< e
  double completion_order = 0.0;      ///< g
  double completion_exponent = 0.0;   ///< z
  double completion_start = 0.0;      ///< F_2

  static ParameterTable<IgnitionAndGrowth> parameters() {
    using P = IgnitionAndGrowth;
    const auto power = range::between(0.0, 30.0), fraction = range::between(0.0, 1.0);
    return {
        real("rate_pressure", &P::rate_pressure, "Pa", range::positive(), "p_r of growth and completion")
            .optional(),
        real("ignition_rate", &P::ignition_rate, "1/s", range::non_negative(), "I"),
        real("ignition_depletion", &P::ignition_depletion, "", power, "b, exponent of 1 - F"),
        real("ignition_threshold", &P::ignition_threshold, "", range::non_negative(),
             "a, compression without ignition"),
        real("ignition_exponent", &P::ignition_exponent, "", power, "x, exponent of the compression"),
        real("ignition_end", &P::ignition_end, "", fraction, "F_i, burn fraction from which on it ends"),
        real("growth_rate", &P::growth_rate, "1/s", range::non_negative(), "G1, at the pressure p_r"),
        real("growth_depletion", &P::growth_depletion, "", power, "c, exponent of 1 - F"),
        real("growth_order", &P::growth_order, "", power, "d, exponent of F"),
        real("growth_exponent", &P::growth_exponent, "", power, "y, exponent of the pressure"),
        real("growth_end", &P::growth_end, "", fraction, "F_1, burn fraction from which on it ends"),
        real("completion_rate", &P::completion_rate, "1/s", range::non_negative(), "G2, at the pressure p_r"),
        real("completion_depletion", &P::completion_depletion, "", power, "e, exponent of 1 - F"),
        real("completion_order", &P::completion_order, "", power, "g, exponent of F"),
        real("completion_exponent", &P::completion_exponent, "", power, "z, exponent of the pressure"),
        real("completion_start", &P::completion_start, "", fraction,
             "F_2, burn fraction from which on it counts")};
  }
  static constexpr const char* name = "ignition_and_growth";
  static constexpr const char* summary =
      "ignition by compression, growth by pressure (Lee and Tarver), for initiation by shocks";
  static constexpr const char* theory =
      "dF/dt = I (1 - F)^b (rho/rho0 - 1 - a)^x [F < F_i] + G1 (1 - F)^c F^d (p/p_r)^y [F < F_1]\n"
      "      + G2 (1 - F)^e F^g (p/p_r)^z [F >= F_2]; reactant and products at one pressure and "
      "temperature.\n"
      "Source: Lee and Tarver, Phys. Fluids 23 (1980) 2362; Tarver, Hallquist and Erickson, 8th Symp. (Int.) "
      "on\n"
      "Detonation (1985) 951.";

  /// @throws InputError if nothing would ever burn
  void require_consistent() const {
    if (!(ignition_rate > 0.0 && ignition_end > 0.0)) {
      throw InputError(
          "'ignition_rate' and 'ignition_end' must be positive: growth starts from what has ignited");
    }
  }
  /// Returns dF/dt of a point.
  [[nodiscard]] double rate(double F, double compression, double pressure) const {
    const double left = 1.0 - F, eta = compression - 1.0 - ignition_threshold, P = pressure / rate_pressure;
    if (!(left > 0.0)) return 0.0;
    double rate = 0.0;
    if (F < ignition_end && eta > 0.0) {
      rate += ignition_rate * std::pow(left, ignition_depletion) * std::pow(eta, ignition_exponent);
    }
    if (!(P > 0.0) || !(F > 0.0)) return rate;
    if (F < growth_end) {
      rate += growth_rate * std::pow(left, growth_depletion) * std::pow(F, growth_order) *
              std::pow(P, growth_exponent);
    }
    if (F >= completion_start) {
      rate += completion_rate * std::pow(left, completion_depletion) * std::pow(F, completion_order) *
              std::pow(P, completion_exponent);
    }
    return rate;
  }
  void advance(const State& state, std::span<double> burnt) const {
    for (std::size_t i = 0; i < burnt.size(); ++i) {
      const auto rate_at = [&](double F) { return rate(F, state.compression[i], state.pressure[i]); };
      double& F = burnt[i];
      double left = state.time_step;
      while (left > 0.0 && F < 1.0) {
        const double at_start = rate_at(F);
        if (!(at_start > 0.0)) break;
        const double next = next_limit(F), room = std::min(next - F, largest_step);
        const double trial = std::min(left, room / at_start), middle = F + 0.5 * trial * at_start;
        // Closer to a limit than the resolution of numbers, the midpoint is not inside the step.
        const double slope = middle > F && middle < next ? rate_at(middle) : at_start;
        const double step = std::min(trial, room / slope), burns = step * slope;
        F = burns < (1.0 - nearness) * (next - F) ? F + burns : next;
        left -= step;
      }
    }
  }

 private:
  /// Returns the smallest burn fraction above F at which a term begins or ends: no step crosses it.
  [[nodiscard]] double next_limit(double F) const {
    double next = 1.0;
    for (const double limit : {ignition_end, growth_end, completion_start})
      next = limit > F ? std::min(next, limit) : next;
    return next;
  }
};

}  // namespace whipple::reaction

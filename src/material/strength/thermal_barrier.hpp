// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/radial_return.hpp"

namespace whipple::strength {

/// Describes a barrier that dislocations pass by thermal activation. The fraction of its threshold stress (the stress
/// at 0 K) that is required is
///   S = [1 - (kT/(g0 b^3 G) ln(rate_0/rate))^(1/q)]^(1/p)   in [0, 1].
struct ThermalBarrier {
  double energy = 0.0;  ///< g0 over G b^3; like all constants 0 without a barrier
  double rate = 0.0;    ///< rate_0 of the attempts, 1/s
  double p = 0.0, q = 0.0;

  /// Returns the table of the constants.
  /// @param name  first part of the keys
  /// @param of  the threshold stress, for the meanings
  /// @param required  whether the barrier always exists
  static ParameterTable<ThermalBarrier> parameters(const std::string& name, const std::string& of,
                                                   bool required) {
    using P = ThermalBarrier;
    const Range allowed = required ? range::positive() : range::non_negative();  // 0: no barrier
    ParameterTable<P> table = {
        real(name + "_energy", &P::energy, "", allowed, "g0: activation energy of " + of + " over G b^3"),
        real(name + "_rate", &P::rate, "1/s", allowed, "rate_0: of the attempts to pass " + of),
        real(name + "_p", &P::p, "", allowed, "p of the profile of " + of),
        real(name + "_q", &P::q, "", allowed, "q of the profile of " + of)};
    if (required) return table;
    for (UnboundParameter& parameter : table) {
      parameter.info.required = false;
      parameter.info.default_text = "none without " + of;
    }
    return table;
  }
  /// Returns how many of its constants are given; only 0 and 4 are consistent.
  [[nodiscard]] int given() const {
    int count = 0;
    for (const double constant : {energy, rate, p, q}) count += constant > 0.0 ? 1 : 0;
    return count;
  }
  /// Returns S and its derivative with respect to ln(rate).
  /// @param thermal  kT/(b^3 G)
  [[nodiscard]] FlowStress passed(double thermal, double log_rate) const {
    const double per_log = thermal / energy, work = per_log * (std::log(rate) - log_rate);
    if (!(work > 0.0)) return {1.0, 0.0};
    const double root = std::pow(work, 1.0 / q), left = 1.0 - root;
    if (!(left > 0.0)) return {0.0, 0.0};
    const double fraction = std::pow(left, 1.0 / p);
    return {fraction, fraction / (p * left) * root / (q * work) * per_log};
  }
};

}  // namespace whipple::strength

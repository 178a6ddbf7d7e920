// SPDX-License-Identifier: BSD-3-Clause
#include "eos/loci/thresholds.hpp"

#include <algorithm>
#include <functional>

#include "eos/loci/isentrope.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double first_pressure = 1e9;
constexpr double growth = 1.25;
constexpr double tolerance = 1e-9;

/// Finds the weakest shock on the principal Hugoniot with a property that also holds for all stronger shocks.
class ShockScan {
 public:
  explicit ShockScan(const EquationOfState& eos, double highest_pressure)
      : hugoniot_(eos), highest_(highest_pressure) {}

  /// Returns the weakest shock with the property; nothing if material at rest has it, or no shock within the range.
  [[nodiscard]] std::optional<ShockState> weakest(const std::function<bool(const State&)>& holds) const {
    double lower = std::max(hugoniot_.initial().pressure, 0.0);
    double upper = std::min(std::max(first_pressure, 2 * lower), highest_);
    try {
      if (holds(hugoniot_.initial())) return std::nullopt;
      while (!holds(hugoniot_.at_pressure(upper).state)) {
        if (upper >= highest_) return std::nullopt;
        lower = upper;
        upper = std::min(growth * upper, highest_);
      }
      for (int i = 0; i < 60 && upper - lower > tolerance * upper; ++i) {
        const double middle = 0.5 * (lower + upper);
        (holds(hugoniot_.at_pressure(middle).state) ? upper : lower) = middle;
      }
      return hugoniot_.at_pressure(0.5 * (lower + upper));
    } catch (const StateError&) {
      return std::nullopt;  // the range of the model ends before, or has a gap
    }
  }

 private:
  Hugoniot hugoniot_;
  double highest_;
};

}  // namespace

std::optional<ShockMelting> shock_melting(const EquationOfState& eos, double highest_pressure) {
  const ShockScan scan(eos, highest_pressure);
  const auto completion = scan.weakest([](const State& s) { return s.melted_fraction >= 1; });
  const auto onset =
      completion ? scan.weakest([](const State& s) { return s.melted_fraction > 0; }) : std::nullopt;
  if (!onset) return std::nullopt;
  return ShockMelting{*onset, *completion};
}

ReleaseThresholds release_thresholds(const EquationOfState& eos, double pressure, double highest_pressure) {
  const ShockScan scan(eos, highest_pressure);
  const auto released = [&](const State& s) { return release(eos, s, pressure).end.state; };
  const bool dome = eos.vapour_dome() != nullptr && eos.vapour_dome()->at_pressure(pressure);
  ReleaseThresholds result;
  result.incipient_melting = scan.weakest([&](const State& s) { return released(s).melted_fraction > 0; });
  if (result.incipient_melting) {
    result.complete_melting = scan.weakest([&](const State& s) { return released(s).melted_fraction >= 1; });
  }
  if (dome) {
    const auto vapour = [&](const State& s) { return released(s).vaporised_fraction; };
    result.incipient_vaporisation = scan.weakest([&](const State& s) { return vapour(s) > 0; });
    result.complete_vaporisation = scan.weakest([&](const State& s) { return vapour(s) >= 1; });
  }
  return result;
}

}  // namespace whipple::eos

// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/outcomes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "eos/loci.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/gray.hpp"
#include "md_fitting/fit/table_access.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using eos::EquationOfState;
using md::AdaptivePlan;

std::optional<double> pressure_of(const std::optional<eos::ShockState>& shock) {
  return shock ? std::optional(shock->state.pressure) : std::nullopt;
}

struct Entry {
  const char* name;
  const char* unit;
  std::optional<double> (*value)(const EquationOfState& eos, const AdaptivePlan& wish);
};

eos::State behind_shock(const EquationOfState& eos, const AdaptivePlan& wish) {
  return eos::Hugoniot(eos).at_density(eos.reference_density() / wish.volume_ratio).state;
}

/// Lists one entry per name of `md::adaptive_outcomes`.
constexpr std::array entries = {
    Entry{"hugoniot_pressure", "Pa",
          [](const EquationOfState& eos, const AdaptivePlan& wish) -> std::optional<double> {
            return behind_shock(eos, wish).pressure;
          }},
    Entry{"hugoniot_temperature", "K",
          [](const EquationOfState& eos, const AdaptivePlan& wish) -> std::optional<double> {
            return behind_shock(eos, wish).temperature;
          }},
    Entry{"shock_melting_pressure", "Pa",
          [](const EquationOfState& eos, const AdaptivePlan&) -> std::optional<double> {
            const auto melting = eos::shock_melting(eos);
            return melting ? std::optional(melting->onset.state.pressure) : std::nullopt;
          }},
    Entry{"shock_melting_completion_pressure", "Pa",
          [](const EquationOfState& eos, const AdaptivePlan&) -> std::optional<double> {
            const auto melting = eos::shock_melting(eos);
            return melting ? std::optional(melting->completion.state.pressure) : std::nullopt;
          }},
    Entry{"release_melting_pressure", "Pa",
          [](const EquationOfState& eos, const AdaptivePlan& wish) {
            return pressure_of(eos::release_thresholds(eos, wish.pressure).incipient_melting);
          }},
    Entry{"release_complete_melting_pressure", "Pa",
          [](const EquationOfState& eos, const AdaptivePlan& wish) {
            return pressure_of(eos::release_thresholds(eos, wish.pressure).complete_melting);
          }},
    Entry{"release_vaporisation_pressure", "Pa",
          [](const EquationOfState& eos, const AdaptivePlan& wish) {
            return pressure_of(eos::release_thresholds(eos, wish.pressure).incipient_vaporisation);
          }},
    Entry{"melting_temperature", "K",
          [](const EquationOfState& eos, const AdaptivePlan& wish) -> std::optional<double> {
            const auto melting = eos::melting_point(eos, wish.pressure);
            return melting ? std::optional(melting->solidus.temperature) : std::nullopt;
          }}};

}  // namespace

Outcome outcome_of(const eos::GrayConstants& constants, const AdaptivePlan& wish) {
  const auto entry = std::find_if(entries.begin(), entries.end(),
                                  [&](const Entry& one) { return wish.outcome == one.name; });
  if (entry == entries.end()) throw InternalError(fmt::format("unknown outcome '{}'", wish.outcome));
  const eos::ModelEquationOfState<eos::Gray> model(constants);
  const std::optional<double> value = entry->value(model, wish);
  if (!value) throw StateError(fmt::format("the fitted equation of state has no {}", wish.outcome));
  return {*value, entry->unit};
}

Eigen::VectorXd outcome_gradient(const eos::GrayConstants& constants, const AdaptivePlan& wish,
                                 const std::vector<std::string>& names, const Eigen::VectorXd& errors) {
  constexpr double share_of_error = 0.25;
  const double centre = outcome_of(constants, wish).value;
  Eigen::VectorXd gradient(static_cast<Index>(names.size()));
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double step = share_of_error * errors[static_cast<Index>(k)];
    const auto moved = [&](double by) -> std::optional<double> {
      eos::GrayConstants trial = constants;
      number_of(trial, names[k]) += by;
      try {
        return outcome_of(trial, wish).value;
      } catch (const StateError&) {
        return std::nullopt;
      } catch (const InputError&) {
        return std::nullopt;  // the constants contradict each other
      }
    };
    const std::optional<double> above = moved(step);
    const std::optional<double> below = moved(-step);
    if (!above && !below) {
      throw StateError(fmt::format("{} exists for no other {} than the fitted one", wish.outcome, names[k]));
    }
    const double width = (above ? step : 0.0) + (below ? step : 0.0);
    gradient[static_cast<Index>(k)] = (above.value_or(centre) - below.value_or(centre)) / width;
  }
  return gradient;
}

}  // namespace whipple::fit

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/mechanical_threshold.hpp"
#include "src/material/strength/radial_return.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// Implements Strength for MechanicalThreshold.
class MechanicalThresholdModel final : public Strength {
 public:
  /// @throws InputError if the constants are inconsistent
  explicit MechanicalThresholdModel(const MechanicalThreshold& constants) : constants_(constants) {
    constants.require_consistent();
  }

  [[nodiscard]] std::string_view model() const override { return MechanicalThreshold::name; }
  [[nodiscard]] std::optional<double> initial_threshold() const override {
    return constants_.initial_threshold;
  }
  void shear_modulus(const State& state, std::span<double> modulus) const override {
    for (std::size_t i = 0; i < modulus.size(); ++i) modulus[i] = modulus_of(state, i);
  }
  void plastic_increment(const State& state, std::span<const double> trial, std::span<const double> modulus,
                         std::span<const double> solid_fraction, double dt,
                         std::span<double> increment) const override {
    for (std::size_t i = 0; i < increment.size(); ++i) {
      const double solid = molten(state, i) ? 0.0 : solid_fraction[i];
      // Y is never below its athermal part: avoids the formula for most elastic points.
      if (trial[i] <= solid * constants_.athermal_stress) {
        increment[i] = 0.0;
        continue;
      }
      const MechanicalThreshold::Condition at =
          constants_.condition(state.temperature[i], modulus[i] / solid_fraction[i]);
      const auto flow = [&](double x) { return constants_.flow(state.threshold[i], x, dt, at); };
      increment[i] =
          radial_return(trial[i], modulus[i], solid, constants_.least_flow(state.threshold[i], at), flow);
    }
  }
  void advance_threshold(const State& state, std::span<const double> increment, double dt,
                         std::span<double> threshold) const override {
    for (std::size_t i = 0; i < increment.size(); ++i) {
      if (!(increment[i] > 0.0) || molten(state, i)) continue;
      threshold[i] = constants_
                         .threshold(threshold[i], increment[i], constants_.log_rate(increment[i] / dt),
                                    constants_.condition(state.temperature[i], modulus_of(state, i)))
                         .value;
    }
  }
  void flow_stress(const State& state, std::span<const double> rate,
                   std::span<double> stress) const override {
    for (std::size_t i = 0; i < stress.size(); ++i) {
      const double flow = constants_
                              .flow(state.threshold[i], no_strain, no_strain / std::max(rate[i], 1e-300),
                                    constants_.condition(state.temperature[i], modulus_of(state, i)))
                              .value;
      stress[i] = molten(state, i) ? 0.0 : flow;
    }
  }
  [[nodiscard]] std::string constants() const override {
    MechanicalThreshold copy = constants_;
    return fmt::format("model = \"{}\"\n{}", MechanicalThreshold::name,
                       to_toml(whipple::bind(MechanicalThreshold::parameters(), copy)));
  }

 private:
  static constexpr double no_strain = 1e-30;
  [[nodiscard]] bool molten(const State& state, std::size_t i) const {
    return state.temperature[i] >= constants_.melting_temperature;
  }
  [[nodiscard]] double modulus_of(const State& state, std::size_t i) const {
    return constants_.modulus(state.density[i], state.pressure[i], state.temperature[i]);
  }
  MechanicalThreshold constants_;
};

}  // namespace whipple::strength

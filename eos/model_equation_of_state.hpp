// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::eos {

/// Requires a model to be a plain struct of constants with a parameter table, and functions on points and batches.
template <class M>
concept Model = requires(const M& model, const Batch& batch, double number) {
  typename M::Constants;
  { M::parameters() } -> std::same_as<ParameterTable<typename M::Constants>>;
  { M::name } -> std::convertible_to<std::string_view>;
  { M::summary } -> std::convertible_to<std::string_view>;
  { model.constants() } -> std::same_as<const typename M::Constants&>;
  { model.evaluate(batch) } -> std::same_as<RangeReport>;
  { model.state(number, number) } -> std::same_as<State>;
  { model.state_at_temperature(number, number) } -> std::same_as<State>;
  { model.reference_density() } -> std::same_as<double>;
  { model.reference_temperature() } -> std::same_as<double>;
  { model.reference_energy() } -> std::same_as<double>;
  { model.maximum_density() } -> std::same_as<double>;
  { model.minimum_energy(number) } -> std::same_as<double>;
  { M::least_temperature } -> std::convertible_to<double>;
};

/// Adapts a model to the run-time interface: one virtual call per batch.
template <Model M>
class ModelEquationOfState final : public EquationOfState {
 public:
  explicit ModelEquationOfState(const typename M::Constants& constants) : model_(constants) {}
  explicit ModelEquationOfState(const M& model) : model_(model) {}

  [[nodiscard]] const M& underlying() const { return model_; }

  [[nodiscard]] std::string_view model() const override { return M::name; }
  [[nodiscard]] double reference_density() const override { return model_.reference_density(); }
  [[nodiscard]] double reference_temperature() const override { return model_.reference_temperature(); }
  [[nodiscard]] double reference_energy() const override { return model_.reference_energy(); }
  [[nodiscard]] bool condensed() const override {
    if constexpr (requires { model_.condensed(); }) {
      return model_.condensed();
    } else {
      return true;
    }
  }
  [[nodiscard]] bool detonates() const override {
    if constexpr (requires { M::detonates; }) {
      return M::detonates;
    } else {
      return false;
    }
  }
  [[nodiscard]] bool has_phases() const override {
    if constexpr (requires { M::has_phases; }) {
      return M::has_phases;
    } else {
      return true;
    }
  }
  [[nodiscard]] double relative_cost() const override {
    if constexpr (requires { M::relative_cost; }) {
      return M::relative_cost;
    } else {
      return 1.0;
    }
  }
  [[nodiscard]] double maximum_density() const override { return model_.maximum_density(); }
  [[nodiscard]] double minimum_energy(double density) const override {
    return model_.minimum_energy(density);
  }
  [[nodiscard]] double least_temperature() const override { return M::least_temperature; }
  [[nodiscard]] double intended_temperature() const override {
    if constexpr (requires { M::intended_temperature; }) {
      return M::intended_temperature;
    } else {
      return EquationOfState::intended_temperature();
    }
  }
  RangeReport evaluate(const Batch& batch) const override { return model_.evaluate(batch); }
  RangeReport integrate(const Batch& batch, std::span<double> energy,
                        std::span<const double> half_change) const override {
    if constexpr (requires { model_.integrate(batch, energy, half_change); }) {
      return model_.integrate(batch, energy, half_change);
    } else {
      return EquationOfState::integrate(batch, energy, half_change);
    }
  }
  [[nodiscard]] State state(double density, double specific_internal_energy) const override {
    return derived(model_.state(density, specific_internal_energy));
  }
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override {
    return derived(model_.state_at_temperature(density, temperature));
  }
  [[nodiscard]] const VapourDome* vapour_dome() const override {
    if constexpr (requires { model_.dome(); }) {
      return &model_.dome();
    } else {
      return nullptr;
    }
  }
  [[nodiscard]] std::vector<double> kinks() const override {
    if constexpr (requires { model_.kinks(); }) {
      return model_.kinks();
    } else {
      return {};
    }
  }
  [[nodiscard]] double initial_distension() const override {
    if constexpr (requires { model_.initial_distension(); }) {
      return model_.initial_distension();
    } else {
      return 1.0;
    }
  }
  [[nodiscard]] std::unique_ptr<EquationOfState> unloading(const State& from) const override {
    if constexpr (requires { model_.unloading(from); }) {
      return model_.unloading(from);
    } else {
      return nullptr;
    }
  }
  [[nodiscard]] std::string constants() const override {
    typename M::Constants values = model_.constants();
    return to_toml(whipple::bind(M::parameters(), values));
  }

 private:
  static State derived(State state) {
    derive(state);
    return state;
  }

  M model_;
};

}  // namespace whipple::eos

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/return_in_batch.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// Implements Strength for a flow law with a constant shear modulus. A law is a plain struct of constants that derives
/// from ElasticConstants, with
///   flow_stress(plastic_strain, rate, temperature)                                Pa, of the solid
///   increment(trial, plastic_strain, temperature, modulus, solid_fraction, dt)    see Strength
///   require_consistent()                                                          throws InputError
/// and, if it hardens kinematically,
///   kinematic_modulus                                                             Pa
/// and, if it is a BatchLaw,
///   may_yield(trial, temperature, modulus, solid_fraction)                        false: the increment is 0
///   solve(points, dt)                                                             instead of `increment`
template <class Law>
class FlowLawModel final : public Strength {
 public:
  /// @throws InputError if the constants are inconsistent
  explicit FlowLawModel(const Law& law) : law_(law), modulus_(law.stiffness()) { law.require_consistent(); }

  [[nodiscard]] const Law& law() const { return law_; }
  [[nodiscard]] std::string_view model() const override { return Law::name; }
  void shear_modulus(const State&, std::span<double> modulus) const override {
    std::ranges::fill(modulus, modulus_);
  }
  void plastic_increment(const State& state, std::span<const double> trial, std::span<const double> modulus,
                         std::span<const double> solid_fraction, double dt,
                         std::span<double> increment) const override {
    if constexpr (BatchLaw<Law>) {
      return_in_batch(law_, state, trial, modulus, solid_fraction, dt, increment);
    } else {
      for (std::size_t i = 0; i < trial.size(); ++i) {
        increment[i] = law_.increment(trial[i], state.plastic_strain[i], state.temperature[i], modulus[i],
                                      solid_fraction[i], dt);
      }
    }
  }
  void flow_stress(const State& state, std::span<const double> rate,
                   std::span<double> stress) const override {
    for (std::size_t i = 0; i < stress.size(); ++i) {
      stress[i] = law_.flow_stress(state.plastic_strain[i], rate[i], state.temperature[i]);
    }
  }
  [[nodiscard]] double kinematic_modulus() const override {
    if constexpr (requires { law_.kinematic_modulus; }) return law_.kinematic_modulus;
    return 0.0;
  }
  [[nodiscard]] std::string constants() const override {
    Law copy = law_;
    return fmt::format("model = \"{}\"\n{}", Law::name, to_toml(whipple::bind(Law::parameters(), copy)));
  }

 private:
  Law law_;
  double modulus_;
};

}  // namespace whipple::strength

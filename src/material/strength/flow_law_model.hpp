// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <concepts>

#include "src/base/parameter_table.hpp"
#include "src/base/vector_math.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// The run-time face of a flow law with a constant shear modulus. A law is a plain struct of constants that
/// derives from ElasticConstants, with
///   flow_stress(plastic_strain, rate, temperature)                                Pa, of the solid
///   increment(trial, plastic_strain, temperature, modulus, solid_fraction, dt)    see Strength
///   require_consistent()                                                          throws InputError
/// and, if it hardens kinematically, kinematic_modulus                             Pa
/// A law with costly functions has `increment` for four points at once, and
///   may_yield(trial, temperature, solid_fraction)                                 false: the increment is 0
template <class Law>
concept FourfoldLaw = requires(const Law& law, Lanes x, double dt) {
  { law.increment(x, x, x, x, x, dt) } -> std::same_as<Lanes>;
};

template <class Law>
class FlowLawModel final : public Strength {
 public:
  /// @throws InputError if the constants contradict one another
  explicit FlowLawModel(const Law& law) : law_(law), modulus_(law.stiffness()) { law.require_consistent(); }

  [[nodiscard]] std::string_view model() const override { return Law::name; }
  void shear_modulus(const State&, std::span<double> modulus) const override {
    std::ranges::fill(modulus, modulus_);
  }
  void plastic_increment(const State& state, std::span<const double> trial, std::span<const double> modulus,
                         std::span<const double> solid_fraction, double dt,
                         std::span<double> increment) const override {
    if constexpr (FourfoldLaw<Law>) {
      std::array<std::size_t, 4> group;
      std::size_t members = 0;
      const auto solve = [&] {
        const auto of_group = [&](std::span<const double> values) {
          return Lanes{values[group[0]], values[group[1]], values[group[2]], values[group[3]]};
        };
        const Lanes result =
            law_.increment(of_group(trial), of_group(state.plastic_strain), of_group(state.temperature),
                           of_group(modulus), of_group(solid_fraction), dt);
        for (std::size_t k = 0; k < members; ++k) increment[group[k]] = result[k];
        members = 0;
      };
      for (std::size_t i = 0; i < trial.size(); ++i) {
        increment[i] = 0.0;
        if (!law_.may_yield(trial[i], state.temperature[i], solid_fraction[i])) continue;
        if (members == 0) group.fill(i);  // what is missing in the last group repeats its first point
        group[members++] = i;
        if (members == group.size()) solve();
      }
      if (members > 0) solve();
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

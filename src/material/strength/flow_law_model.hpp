// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

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
/// A law with costly functions solves groups of four points: it has a struct `Return` with trial,
/// plastic_strain, temperature, modulus, solid (in) and increment (out), and
///   solve(groups, dt)
///   may_yield(trial, temperature, solid_fraction)                                 false: the increment is 0
template <class Law>
concept FourfoldLaw =
    requires(const Law& law, typename Law::Return group, double dt) { law.solve(std::span(&group, 1), dt); };

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
      std::array<std::size_t, 4 * groups> yielding;
      std::size_t count = 0;
      const auto solve = [&] {
        solve_groups(state, trial, modulus, solid_fraction, dt, std::span(yielding.data(), count), increment);
        count = 0;
      };
      for (std::size_t i = 0; i < trial.size(); ++i) {
        increment[i] = 0.0;
        yielding[count] = i;
        count += law_.may_yield(trial[i], state.temperature[i], solid_fraction[i]) ? 1 : 0;
        if (count == yielding.size()) solve();
      }
      if (count > 0) solve();
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
  static constexpr std::size_t groups = 8;  ///< of four points that are solved together

  void solve_groups(const State& state, std::span<const double> trial, std::span<const double> modulus,
                    std::span<const double> solid_fraction, double dt, std::span<const std::size_t> points,
                    std::span<double> increment) const
    requires FourfoldLaw<Law>
  {
    std::array<typename Law::Return, groups> returns;
    const std::size_t used = (points.size() + 3) / 4;
    for (std::size_t g = 0; g < used; ++g) {
      for (std::size_t k = 0; k < 4; ++k) {
        // What is missing in the last group repeats its first point.
        const std::size_t i = points[4 * g + k < points.size() ? 4 * g + k : 4 * g];
        returns[g].trial[k] = trial[i];
        returns[g].plastic_strain[k] = state.plastic_strain[i];
        returns[g].temperature[k] = state.temperature[i];
        returns[g].modulus[k] = modulus[i];
        returns[g].solid[k] = solid_fraction[i];
      }
    }
    law_.solve(std::span(returns.data(), used), dt);
    for (std::size_t n = 0; n < points.size(); ++n) increment[points[n]] = returns[n / 4].increment[n % 4];
  }

  Law law_;
  double modulus_;
};

}  // namespace whipple::strength

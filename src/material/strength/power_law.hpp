// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/parameter_table.hpp"
#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/radial_return.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// Power-law isotropic hardening, Y = A + B ep^n, independent of rate and temperature. Source: P. Ludwik,
/// Elemente der technologischen Mechanik (Springer 1909).
struct PowerLaw : ElasticConstants {
  double yield_stress = 0.0;           ///< A, Pa
  double hardening_coefficient = 0.0;  ///< B, Pa
  double hardening_exponent = 1.0;     ///< n

  static ParameterTable<PowerLaw> parameters() {
    using P = PowerLaw;
    ParameterTable<P> table = ElasticConstants::parameters<P>();
    table.push_back(real("yield_stress", &P::yield_stress, "Pa", range::positive(), "A"));
    table.push_back(
        real("hardening_coefficient", &P::hardening_coefficient, "Pa", range::non_negative(), "B"));
    table.push_back(real("hardening_exponent", &P::hardening_exponent, "", range::positive(), "n"));
    return table;
  }
  static constexpr const char* name = "power_law";
  static constexpr const char* summary = "von Mises plasticity with power-law isotropic hardening";
  static constexpr const char* theory =
      "Y = A + B ep^n, times the solid fraction; shear modulus G times the solid fraction.\n"
      "Source: Ludwik, Elemente der technologischen Mechanik (1909).";

  [[nodiscard]] FlowStress flow(double strain) const {
    if (strain <= 0.0) return {yield_stress, 0.0};
    const double power = hardening_coefficient * std::pow(strain, hardening_exponent);
    return {yield_stress + power, hardening_exponent * power / strain};
  }
};

class PowerLawModel final : public Strength {
 public:
  /// @throws InputError if the elastic constants contradict one another
  explicit PowerLawModel(const PowerLaw& constants)
      : constants_(constants), modulus_(constants.stiffness()) {}

  [[nodiscard]] std::string_view model() const override { return PowerLaw::name; }
  void shear_modulus(const State&, std::span<double> modulus) const override {
    std::ranges::fill(modulus, modulus_);
  }
  void plastic_increment(const State& state, std::span<const double> trial, std::span<const double> modulus,
                         std::span<const double> solid_fraction, double,
                         std::span<double> increment) const override {
    for (std::size_t i = 0; i < trial.size(); ++i) {
      const double strain = state.plastic_strain[i];
      increment[i] = radial_return(trial[i], modulus[i], solid_fraction[i], constants_.flow(strain).value,
                                   [&](double x) { return constants_.flow(strain + x); });
    }
  }
  [[nodiscard]] double flow_stress(double plastic_strain, double, double) const override {
    return constants_.flow(plastic_strain).value;
  }
  [[nodiscard]] std::string constants() const override {
    PowerLaw copy = constants_;
    const auto bound = whipple::bind(PowerLaw::parameters(), copy);
    return fmt::format("model = \"{}\"\n{}", PowerLaw::name, to_toml(bound));
  }

 private:
  PowerLaw constants_;
  double modulus_;
};

}  // namespace whipple::strength

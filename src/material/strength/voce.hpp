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

/// Isotropic hardening that saturates, Y = A + Q1 [1 - exp(-b1 ep)] + Q2 [1 - exp(-b2 ep)], independent of
/// rate and temperature. Source: E. Voce, J. Inst. Metals 74 (1948) 537; two terms as in F. Grytten et al.,
/// Int. J. Impact Eng. 36 (2009) 416.
struct Voce : ElasticConstants {
  double yield_stress = 0.0;                          ///< A, Pa
  double first_saturation = 0.0, first_rate = 0.0;    ///< Q1, Pa; b1
  double second_saturation = 0.0, second_rate = 0.0;  ///< Q2, Pa; b2

  static ParameterTable<Voce> parameters() {
    using P = Voce;
    ParameterTable<P> table = ElasticConstants::parameters<P>();
    table.push_back(real("yield_stress", &P::yield_stress, "Pa", range::positive(), "A"));
    table.push_back(real("first_saturation", &P::first_saturation, "Pa", range::non_negative(), "Q1"));
    table.push_back(real("first_rate", &P::first_rate, "", range::non_negative(), "b1"));
    table.push_back(
        real("second_saturation", &P::second_saturation, "Pa", range::non_negative(), "Q2").optional());
    table.push_back(real("second_rate", &P::second_rate, "", range::non_negative(), "b2").optional());
    return table;
  }
  static constexpr const char* name = "voce";
  static constexpr const char* summary = "von Mises plasticity with saturating isotropic hardening";
  static constexpr const char* theory =
      "Y = A + Q1 [1 - exp(-b1 ep)] + Q2 [1 - exp(-b2 ep)], times the solid fraction; shear modulus G times\n"
      "the solid fraction. Source: Voce, J. Inst. Metals 74 (1948) 537.";

  [[nodiscard]] FlowStress flow(double strain) const {
    const double first = first_saturation * std::exp(-first_rate * strain);
    const double second = second_saturation * std::exp(-second_rate * strain);
    return {yield_stress + first_saturation - first + second_saturation - second,
            first_rate * first + second_rate * second};
  }
};

class VoceModel final : public Strength {
 public:
  /// @throws InputError if the elastic constants contradict one another
  explicit VoceModel(const Voce& constants) : constants_(constants), modulus_(constants.stiffness()) {}

  [[nodiscard]] std::string_view model() const override { return Voce::name; }
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
    Voce copy = constants_;
    const auto bound = whipple::bind(Voce::parameters(), copy);
    return fmt::format("model = \"{}\"\n{}", Voce::name, to_toml(bound));
  }

 private:
  Voce constants_;
  double modulus_;
};

}  // namespace whipple::strength

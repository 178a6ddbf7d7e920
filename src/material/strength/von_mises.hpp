// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>

#include "src/base/parameter_table.hpp"
#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// Linear isotropic hardening: Y(ep) = min(A + B ep, Y_max), independent of rate and temperature.
/// The return is closed: x = (q - w Y(ep)) / (3 G + w B), or (q - w Y_max) / (3 G) on the plateau.
/// Source: M. L. Wilkins, Calculation of elastic-plastic flow, UCRL-7322 (1963); radial return with
/// hardening: J. C. Simo, T. J. R. Hughes, Computational Inelasticity (Springer 1998), box 3.1.
struct VonMises : ElasticConstants {
  double yield_stress = 0.0;                                             ///< A, Pa
  double hardening_modulus = 0.0;                                        ///< B, Pa
  double maximum_flow_stress = std::numeric_limits<double>::infinity();  ///< Y_max, Pa

  static ParameterTable<VonMises> parameters() {
    ParameterTable<VonMises> table = ElasticConstants::parameters<VonMises>();
    table.push_back(
        real("yield_stress", &VonMises::yield_stress, "Pa", range::positive(), "initial yield stress A"));
    table.push_back(real("hardening_modulus", &VonMises::hardening_modulus, "Pa", range::non_negative(),
                         "slope B of the flow stress over equivalent plastic strain")
                        .optional());
    table.push_back(real("maximum_flow_stress", &VonMises::maximum_flow_stress, "Pa", range::positive(),
                         "upper bound Y_max of the flow stress")
                        .optional());
    return table;
  }
  static constexpr const char* name = "von_mises";
  static constexpr const char* summary = "von Mises plasticity with linear isotropic hardening";
  static constexpr const char* theory =
      "Y = min(A + B ep, Y_max), times the solid fraction; shear modulus G times the solid fraction.\n"
      "Source: Wilkins, UCRL-7322 (1963); Simo and Hughes, Computational Inelasticity (1998), box 3.1.";

  [[nodiscard]] double flow_stress(double plastic_strain) const {
    return std::min(yield_stress + hardening_modulus * plastic_strain, maximum_flow_stress);
  }

  /// Increment of the equivalent plastic strain from the equivalent trial stress.
  [[nodiscard]] double increment(double trial, double plastic_strain, double modulus, double solid) const {
    const double yield = solid * flow_stress(plastic_strain);
    if (trial <= yield) return 0.0;
    const double hardening = (trial - yield) / (3.0 * modulus + solid * hardening_modulus);
    const double plateau = (trial - solid * maximum_flow_stress) / (3.0 * modulus);
    return std::max(hardening, plateau);  // the larger is the one whose flow stress is the smaller
  }
};

class VonMisesModel final : public Strength {
 public:
  /// @throws InputError if the constants contradict one another
  explicit VonMisesModel(const VonMises& constants) : constants_(constants), modulus_(constants.stiffness()) {
    if (constants.maximum_flow_stress < constants.yield_stress) {
      throw InputError("'maximum_flow_stress' is less than 'yield_stress'");
    }
  }

  [[nodiscard]] std::string_view model() const override { return VonMises::name; }
  void shear_modulus(const State&, std::span<double> modulus) const override {
    std::ranges::fill(modulus, modulus_);
  }
  void plastic_increment(const State& state, std::span<const double> trial, std::span<const double> modulus,
                         std::span<const double> solid_fraction, double,
                         std::span<double> increment) const override {
    for (std::size_t i = 0; i < trial.size(); ++i) {
      increment[i] = constants_.increment(trial[i], state.plastic_strain[i], modulus[i], solid_fraction[i]);
    }
  }
  [[nodiscard]] double flow_stress(double plastic_strain, double, double) const override {
    return constants_.flow_stress(plastic_strain);
  }
  [[nodiscard]] std::string constants() const override {
    VonMises copy = constants_;
    const auto bound = whipple::bind(VonMises::parameters(), copy);
    return "model = \"von_mises\"\n" + to_toml(bound);
  }

 private:
  VonMises constants_;
  double modulus_;
};

}  // namespace whipple::strength

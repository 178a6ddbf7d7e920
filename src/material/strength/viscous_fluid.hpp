// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// Newtonian fluid: s = 2 eta dev D. Its work is heat; it has no elastic energy. Source: G. K. Batchelor, An
/// Introduction to Fluid Dynamics (Cambridge 1967), sec. 3.3; zero bulk viscosity.
struct ViscousFluid {
  double viscosity = 0.0;  ///< eta, Pa s

  static ParameterTable<ViscousFluid> parameters() {
    return {real("viscosity", &ViscousFluid::viscosity, "Pa s", range::positive(),
                 "dynamic (shear) viscosity eta")};
  }
  static constexpr const char* name = "viscous_fluid";
  static constexpr const char* summary = "Newtonian fluid";
  static constexpr const char* theory =
      "s = 2 eta dev D, D symmetric velocity gradient; its work is heat. The time step is bounded by\n"
      "rho dx^2 / (18 eta).\n"
      "Source: Batchelor, An Introduction to Fluid Dynamics (1967), sec. 3.3.";
};

class ViscousFluidModel final : public Strength {
 public:
  explicit ViscousFluidModel(const ViscousFluid& constants) : constants_(constants) {}
  [[nodiscard]] std::string_view model() const override { return ViscousFluid::name; }
  [[nodiscard]] bool carries_deviator() const override { return false; }
  [[nodiscard]] double viscosity() const override { return constants_.viscosity; }
  void shear_modulus(const State&, std::span<double> modulus) const override {
    std::ranges::fill(modulus, 0.0);
  }
  void plastic_increment(const State&, std::span<const double>, std::span<const double>,
                         std::span<const double>, double, std::span<double> increment) const override {
    std::ranges::fill(increment, 0.0);
  }
  void flow_stress(const State&, std::span<const double>, std::span<double> stress) const override {
    std::ranges::fill(stress, 0.0);
  }
  [[nodiscard]] std::string constants() const override {
    ViscousFluid copy = constants_;
    const auto bound = whipple::bind(ViscousFluid::parameters(), copy);
    return fmt::format("model = \"{}\"\n{}", ViscousFluid::name, to_toml(bound));
  }

 private:
  ViscousFluid constants_;
};

}  // namespace whipple::strength

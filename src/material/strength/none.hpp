// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// Material without deviatoric stress (gas, liquid, or solids far above their strength).
struct None {
  static ParameterTable<None> parameters() { return {}; }
  static constexpr const char* name = "none";
  static constexpr const char* summary = "no deviatoric stress (fluid)";
  static constexpr const char* theory = "s = 0: the stress is the pressure of the equation of state.";
};

class NoneModel final : public Strength {
 public:
  explicit NoneModel(const None& /*constants*/ = {}) {}
  [[nodiscard]] std::string_view model() const override { return None::name; }
  [[nodiscard]] bool carries_deviator() const override { return false; }
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
  [[nodiscard]] std::string constants() const override { return "model = \"none\"\n"; }
};

}  // namespace whipple::strength

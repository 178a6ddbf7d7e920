// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "eos/modifiers/modified.hpp"

namespace whipple::eos {

struct ShiftConstants {
  double energy = 0;  ///< J/kg
};

/// Shifts the origin of the energy: p(rho, e) = p_b(rho, e - energy). Tables and databases use different origins;
/// the difference is significant where material changes its equation of state.
class Shift final : public Modified {
 public:
  using Constants = ShiftConstants;
  static constexpr std::string_view name = "shift";
  static constexpr std::string_view summary = "another origin of the energy";
  static ParameterTable<Constants> parameters() {
    return {real("energy", &Constants::energy, "J/kg", range::any(), "added to every energy")};
  }

  Shift(std::shared_ptr<const EquationOfState> base, const Constants& constants)
      : Modified(std::move(base)), constants_(constants) {
    if (Modified::vapour_dome() != nullptr) {
      dome_ = Modified::vapour_dome()->transformed(1.0, constants_.energy);
    }
  }

  [[nodiscard]] double reference_energy() const override {
    return base().reference_energy() + constants_.energy;
  }
  [[nodiscard]] double minimum_energy(double density) const override {
    return base().minimum_energy(density) + constants_.energy;
  }
  RangeReport evaluate(const Batch& batch) const override {
    return in_chunks(batch, [this](Batch part) {
      ModifierScratch energy;
      const std::size_t size = part.density.size();
      for (std::size_t i = 0; i < size; ++i) energy[i] = part.specific_internal_energy[i] - constants_.energy;
      part.specific_internal_energy = {energy.data(), size};
      return base().evaluate(part);
    });
  }
  [[nodiscard]] State state(double density, double specific_internal_energy) const override {
    return shifted(base().state(density, specific_internal_energy - constants_.energy));
  }
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override {
    return shifted(base().state_at_temperature(density, temperature));
  }
  [[nodiscard]] const VapourDome* vapour_dome() const override { return dome_ ? &*dome_ : nullptr; }
  [[nodiscard]] std::unique_ptr<EquationOfState> unloading(const State& from) const override {
    return unloading_with<Shift>(from, constants_);
  }
  [[nodiscard]] std::string constants() const override { return constants_with_table<Shift>(constants_); }

 private:
  [[nodiscard]] State shifted(State s) const {
    s.specific_internal_energy += constants_.energy;
    derive(s);
    return s;
  }

  Constants constants_;
  std::optional<VapourDome> dome_;
};

}  // namespace whipple::eos

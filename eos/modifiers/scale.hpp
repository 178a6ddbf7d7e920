// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "eos/modifiers/modified.hpp"

namespace whipple::eos {

struct ScaleConstants {
  double density = 1;  ///< density over that of the modified model, at equal volume per atom
};

/// Models material with the same energy and entropy per volume at another density (isotopes, dilute alloys of
/// different atomic mass): with f = density, p(rho, e) = p_b(rho/f, f e), s = s_b/f, c^2 = c_b^2/f;
/// thermodynamically consistent, since V, e and s all scale with 1/f.
class Scale final : public Modified {
 public:
  using Constants = ScaleConstants;
  static constexpr std::string_view name = "scale";
  static constexpr std::string_view summary =
      "another density at the same volume per atom (isotopes, alloys)";
  static ParameterTable<Constants> parameters() {
    return {real("density", &Constants::density, "", range::positive(),
                 "density over that of the model, at equal pressure and temperature")};
  }

  Scale(std::shared_ptr<const EquationOfState> base, const Constants& constants)
      : Modified(std::move(base)), constants_(constants) {
    if (Modified::vapour_dome() != nullptr) {
      dome_ = Modified::vapour_dome()->transformed(1 / constants_.density, 0.0);
    }
  }

  [[nodiscard]] double reference_density() const override {
    return base().reference_density() * constants_.density;
  }
  [[nodiscard]] double reference_energy() const override {
    return base().reference_energy() / constants_.density;
  }
  [[nodiscard]] double maximum_density() const override {
    return base().maximum_density() * constants_.density;
  }
  [[nodiscard]] std::vector<double> kinks() const override {
    std::vector<double> densities = base().kinks();
    for (double& density : densities) density *= constants_.density;
    return densities;
  }
  [[nodiscard]] double minimum_energy(double density) const override {
    return base().minimum_energy(density / constants_.density) / constants_.density;
  }
  RangeReport evaluate(const Batch& batch) const override {
    return in_chunks(batch, [this](Batch part) {
      ModifierScratch density, energy;
      const std::size_t size = part.density.size();
      const double f = constants_.density, slowness = 1 / std::sqrt(f);
      for (std::size_t i = 0; i < size; ++i) {
        density[i] = part.density[i] / f;
        energy[i] = part.specific_internal_energy[i] * f;
      }
      part.density = {density.data(), size};
      part.specific_internal_energy = {energy.data(), size};
      const RangeReport report = base().evaluate(part);
      for (double& c : part.sound_speed) c *= slowness;
      return report;
    });
  }
  [[nodiscard]] State state(double density, double specific_internal_energy) const override {
    return scaled(base().state(density / constants_.density, specific_internal_energy * constants_.density));
  }
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override {
    return scaled(base().state_at_temperature(density / constants_.density, temperature));
  }
  [[nodiscard]] const VapourDome* vapour_dome() const override { return dome_ ? &*dome_ : nullptr; }
  [[nodiscard]] std::unique_ptr<EquationOfState> unloading(const State& from) const override {
    return unloading_with<Scale>(from, constants_);
  }
  [[nodiscard]] std::string constants() const override { return constants_with_table<Scale>(constants_); }

 private:
  [[nodiscard]] State scaled(State s) const {
    const double f = constants_.density;
    s.density *= f;
    s.specific_internal_energy /= f;
    s.specific_entropy /= f;
    s.heat_capacity /= f;
    s.sound_speed /= std::sqrt(f);
    derive(s);
    return s;
  }

  Constants constants_;
  std::optional<VapourDome> dome_;
};

}  // namespace whipple::eos

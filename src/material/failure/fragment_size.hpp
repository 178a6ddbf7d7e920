// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/failure/criterion.hpp"
#include "src/material/failure/fracture_formulas.hpp"

namespace whipple::failure {

/// Makes nothing fail: points that the other criteria fail keep the size of the fragments that they become part of, in the
/// history field `fragment_size` (docs/theory/cracks.md, eq. 8),
///   s = (24 Gamma (1 - f)/(rho D^2))^(1/3),  Gamma = K_c^2/(rho c^2),
/// with the volumetric strain rate D > 0, the density rho of the material and the melted fraction f of the step of failure:
/// where elastic energy rho c^2 (D t)^2/2 has paid for the faces of fragments s = 2 c t wide, within which the news of a
/// crack has spread. Of points that fail while they do not expand there is no size.
/// Source: D. E. Grady, J. Mech. Phys. Solids 36 (1988) 353, of toughness; the loss with melting is this project's choice.
class FragmentSize final : public Criterion {
 public:
  struct Constants {
    double energy_per_area = 0.0;  ///< Gamma, J/m^2

    static ParameterTable<Constants> parameters() {
      return {real("energy_per_area", &Constants::energy_per_area, "J/m^2", range::positive(),
                   "Gamma = K_c^2/(rho c^2), to part the faces of a crack")};
    }
  };
  static constexpr const char* name = "fragment_size";
  static constexpr const char* summary = "no criterion: failed points keep the size of their fragments";
  static constexpr const char* theory =
      "Points that another criterion fails at the volumetric strain rate D > 0 keep the size\n"
      "(24 energy_per_area (1 - melted fraction)/(density D^2))^(1/3) in the field fragment_size; nothing "
      "else changes.\n"
      "Source: Grady, J. Mech. Phys. Solids 36 (1988) 353 (linear loss with melting: own choice).";

  explicit FragmentSize(const Constants& constants) : constants_(constants) {}

  /// Returns the size (m) of the fragments of a point that fails; 0: none.
  /// @param density  kg/m^3, @param melted  mass fraction, @param rate  volumetric strain rate, 1/s
  [[nodiscard]] double size_of(double density, double melted, double rate) const {
    return formulas::fragment_size(constants_.energy_per_area, density, melted, rate);
  }

  [[nodiscard]] const Constants& law() const { return constants_; }
  [[nodiscard]] std::string_view model() const override { return name; }
  void mark(const State& /*state*/, std::span<double> /*damage*/,
            std::span<std::uint8_t> /*failed*/) const override {}
  [[nodiscard]] std::string constants() const override {
    Constants copy = constants_;
    return fmt::format("model = \"{}\"\n{}", name, to_toml(whipple::bind(Constants::parameters(), copy)));
  }

 private:
  Constants constants_;
};

}  // namespace whipple::failure

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "eos/constant_heat_capacity.hpp"
#include "eos/models/gruneisen_solid.hpp"

namespace whipple::eos {

struct PolynomialConstants {
  double reference_density = 0;           ///< rho0, kg/m^3
  double C0 = 0, C1 = 0, C2 = 0, C3 = 0;  ///< Pa
  double C4 = 0, C5 = 0, C6 = 0;          ///< thermal, dimensionless
  double reference_energy = 0;            ///< J/kg, at rho0 and T0
  double heat_capacity = 0;               ///< c_v, J/(kg K)
  double reference_temperature = 300.0;   ///< K
};

/// Models the linear polynomial equation of state of hydrocodes (docs/theory/equations_of_state.md, section 2.2):
///   compression: p = C0 + C1 mu + C2 mu^2 + C3 mu^3 + (C4 + C5 mu + C6 mu^2) rho0 e, mu = rho/rho0 - 1;
///   expansion:   p = C0 + C1 mu + C4 rho e.
/// In expansion C2 and C3 are not used and Gamma remains C4, as in Mie-Grueneisen. A gas has C4 = C5 = gamma - 1
/// and all other coefficients zero.
class PolynomialCurve {
 public:
  using Constants = PolynomialConstants;
  static constexpr std::string_view name = "polynomial";
  static constexpr std::string_view summary =
      "pressure polynomial in compression, linear in the energy; no phases";
  static ParameterTable<Constants> parameters();

  /// @throws InputError naming the constants that contradict each other
  explicit PolynomialCurve(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return constants_.reference_density; }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const { return constants_.reference_energy; }
  [[nodiscard]] double reference_sound_speed() const { return reference_sound_speed_; }
  [[nodiscard]] double heat_capacity() const { return constants_.heat_capacity; }
  [[nodiscard]] bool condensed() const { return constants_.C1 > 0; }
  [[nodiscard]] double maximum_density() const { return solid_.maximum_density(); }
  [[nodiscard]] std::string_view phase(double, double) const { return "condensed"; }

  [[nodiscard]] TabulatedIsochore isochore(Lanes rho) const { return solid_.isochore(rho); }
  using Places = FourfoldTable::Places;
  void find(Lanes rho, Places& places) const { solid_.find(rho, places); }
  [[nodiscard]] TabulatedIsochore usual_isochore(Lanes rho, const Places& places) const {
    return solid_.usual_isochore(rho, places);
  }
  [[nodiscard]] double least_usual_density() const { return solid_.least_usual_density(); }
  [[nodiscard]] const auto& solid() const { return solid_; }
  [[nodiscard]] double log_isentrope_temperature(double rho) const {
    return solid_.log_isentrope_temperature(rho);
  }

 private:
  struct Polynomial {
    double C0, C1, C2, C3;

    ReferencePressure operator()(double mu) const {
      return {C0 + mu * (C1 + mu * (C2 + mu * C3)), C1 + mu * (2 * C2 + 3 * C3 * mu)};
    }
  };

  static GruneisenSolid<Polynomial> solid(const Constants& constants);

  Constants constants_;
  double reference_sound_speed_;
  GruneisenSolid<Polynomial> solid_;
};

using Polynomial = ConstantHeatCapacity<PolynomialCurve>;
extern template class ConstantHeatCapacity<PolynomialCurve>;

}  // namespace whipple::eos

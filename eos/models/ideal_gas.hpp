// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "eos/constant_heat_capacity.hpp"

namespace whipple::eos {

struct IdealGasConstants {
  double reference_density = 0;          ///< rho0, kg/m^3
  double heat_capacity_ratio = 0;        ///< gamma
  double heat_capacity = 0;              ///< c_v, J/(kg K)
  double reference_temperature = 300.0;  ///< K
};

/// Models an ideal gas of constant heat capacity (docs/theory/equations_of_state.md, section 2.4): p = (gamma - 1)
/// rho e, e = c_v T, s = c_v ln(T/T0) - (gamma - 1) c_v ln(rho/rho0).
class IdealGasCurve {
 public:
  using Constants = IdealGasConstants;
  static constexpr std::string_view name = "ideal_gas";
  static constexpr std::string_view summary = "ideal gas of constant heat capacity";
  static constexpr double greatest_compression = 1000;  ///< rho/rho0: no longer a gas beyond
  static ParameterTable<Constants> parameters();

  explicit IdealGasCurve(const Constants& constants) : constants_(constants) {}

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return constants_.reference_density; }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const {
    return constants_.heat_capacity * constants_.reference_temperature;
  }
  [[nodiscard]] double reference_sound_speed() const;
  [[nodiscard]] double heat_capacity() const { return constants_.heat_capacity; }
  [[nodiscard]] bool condensed() const { return false; }
  [[nodiscard]] double maximum_density() const { return greatest_compression * constants_.reference_density; }
  [[nodiscard]] std::string_view phase(double, double) const { return "gas"; }

  [[nodiscard]] LinearIsochore isochore(Lanes rho) const {
    const double G = constants_.heat_capacity_ratio - 1;
    return {G / rho, Lanes{}, Lanes{}, Lanes{}, G * rho, broadcast(G)};
  }
  /// Returns ln(T_s/T0).
  [[nodiscard]] double log_isentrope_temperature(double rho) const;

 private:
  Constants constants_;
};

using IdealGas = ConstantHeatCapacity<IdealGasCurve>;
extern template class ConstantHeatCapacity<IdealGasCurve>;

}  // namespace whipple::eos

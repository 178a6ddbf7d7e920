// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "eos/constant_heat_capacity.hpp"

namespace whipple::eos {

struct StiffenedGasConstants {
  double reference_density = 0;          ///< rho0, kg/m^3
  double heat_capacity_ratio = 0;        ///< gamma
  double stiffness_pressure = 0;         ///< p_inf, Pa
  double heat_capacity = 0;              ///< c_v, J/(kg K)
  double reference_pressure = 0;         ///< p0, Pa
  double reference_temperature = 300.0;  ///< K
};

/// Models a stiffened gas (docs/theory/equations_of_state.md, section 2.4): p = (gamma - 1) rho (e - q) - gamma
/// p_inf, c^2 = gamma (p + p_inf)/rho. The zero q of the energy is such that e = 0 at (rho0, p0). Harlow and
/// Amsden, LA-4700 (1971); Le Metayer, Massoni and Saurel, Int. J. Therm. Sci. 43 (2004) 265. It carries tension
/// down to -p_inf: cavitation is a failure criterion of the material.
class StiffenedGasCurve {
 public:
  using Constants = StiffenedGasConstants;
  static constexpr std::string_view name = "stiffened_gas";
  static constexpr std::string_view summary = "stiffened gas: a liquid as a gas under an inner pressure";
  static ParameterTable<Constants> parameters();

  explicit StiffenedGasCurve(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return constants_.reference_density; }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const { return 0.0; }
  [[nodiscard]] double reference_sound_speed() const;
  [[nodiscard]] double heat_capacity() const { return constants_.heat_capacity; }
  [[nodiscard]] bool condensed() const { return true; }
  [[nodiscard]] double maximum_density() const {
    return greatest_compression_ratio * constants_.reference_density;
  }
  [[nodiscard]] std::string_view phase(double, double) const { return "liquid"; }

  [[nodiscard]] LinearIsochore isochore(Lanes rho) const {
    const double G = constants_.heat_capacity_ratio - 1;
    const Lanes V = 1.0 / rho, B = G * rho;
    // e_c = q + p_inf/rho + e_x (rho/rho0)^(gamma-1)
    Lanes cold_energy = zero_ + constants_.stiffness_pressure * V;
    if (excess_ != 0) cold_energy += excess_ * pow(rho * (1 / constants_.reference_density), broadcast(G));
    return {G * V,
            cold_energy,
            -zero_ * B - constants_.heat_capacity_ratio * constants_.stiffness_pressure,
            broadcast(-zero_ * G),
            B,
            broadcast(G)};
  }
  /// Returns ln(T_s/T0).
  [[nodiscard]] double log_isentrope_temperature(double rho) const;

 private:
  Constants constants_;
  double zero_;    ///< q, J/kg
  double excess_;  ///< e_x, J/kg: zero where rho0, p0, T0 obey p + p_inf = (gamma - 1) rho c_v T
};

using StiffenedGas = ConstantHeatCapacity<StiffenedGasCurve>;
extern template class ConstantHeatCapacity<StiffenedGasCurve>;

}  // namespace whipple::eos

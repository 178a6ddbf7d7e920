// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "eos/constant_heat_capacity.hpp"

namespace whipple::eos {

struct JwlReactantConstants {
  double reference_density = 0;  ///< rho0 of the explosive, kg/m^3
  double pressure_1 = 0;         ///< A, Pa
  double pressure_2 = 0;         ///< B, Pa
  double exponent_1 = 0;         ///< R1
  double exponent_2 = 0;         ///< R2
  double gruneisen = 0;          ///< omega
  double heat_capacity = 0;      ///< c_v, J/(kg K)
};

/// Models the unreacted explosive by the formula of Jones, Wilkins and Lee, as used with the rate laws of ignition
/// and growth (Lee and Tarver, Phys. Fluids 23 (1980) 2362; docs/theory/equations_of_state.md, section 2.5), v =
/// rho0/rho:
///   p = A exp(-R1 v) + B exp(-R2 v) + omega c_v rho T,  e = e_c(rho) + c_v T - [e_c(rho0) + c_v T0],
/// with the cold curve e_c of the products (JwlCurve). At rest e = 0 and p = 0, which determines T0.
class JwlReactantCurve {
 public:
  using Constants = JwlReactantConstants;
  static constexpr std::string_view name = "jwl_reactant";
  static constexpr std::string_view summary =
      "unreacted explosive by the formula of Jones, Wilkins and Lee; no phases";
  static ParameterTable<Constants> parameters();

  /// @throws InputError if the explosive has no zero-pressure state near room temperature, or no sound speed
  explicit JwlReactantCurve(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return constants_.reference_density; }
  [[nodiscard]] double reference_temperature() const { return reference_temperature_; }
  [[nodiscard]] double reference_energy() const { return 0.0; }
  [[nodiscard]] double reference_sound_speed() const { return reference_sound_speed_; }
  [[nodiscard]] double heat_capacity() const { return constants_.heat_capacity; }
  [[nodiscard]] bool condensed() const { return true; }
  /// Returns the density of v = 1/R1, beyond which the first exponential is no longer steep.
  [[nodiscard]] double maximum_density() const {
    return constants_.exponent_1 * constants_.reference_density;
  }
  [[nodiscard]] std::string_view phase(double, double) const { return "explosive"; }

  [[nodiscard]] LinearIsochore isochore(Lanes rho) const {
    const Constants& k = constants_;
    const Lanes V = 1.0 / rho, v = k.reference_density * V;
    const Lanes p1 = k.pressure_1 * exp(-k.exponent_1 * v), p2 = k.pressure_2 * exp(-k.exponent_2 * v);
    const Lanes energy = (1 / (k.exponent_1 * k.reference_density)) * p1 +
                         (1 / (k.exponent_2 * k.reference_density)) * p2 - rest_energy_;
    const Lanes slope = v * V * (k.exponent_1 * p1 + k.exponent_2 * p2);
    return LinearIsochore::on_curve(rho, V, k.gruneisen, p1 + p2, slope, energy, energy);
  }
  /// Returns ln(T_s/T0).
  [[nodiscard]] double log_isentrope_temperature(double rho) const;

 private:
  Constants constants_;
  double rest_energy_ = 0;  ///< e_c(rho0) + c_v T0, J/kg
  double reference_temperature_ = 0;
  double reference_sound_speed_ = 0;
};

using JwlReactant = ConstantHeatCapacity<JwlReactantCurve>;
extern template class ConstantHeatCapacity<JwlReactantCurve>;

}  // namespace whipple::eos

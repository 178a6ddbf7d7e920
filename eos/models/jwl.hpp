// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "eos/constant_heat_capacity.hpp"

namespace whipple::eos {

struct JwlConstants {
  double reference_density = 0;         ///< rho0 of the explosive, kg/m^3
  double pressure_1 = 0;                ///< A, Pa
  double pressure_2 = 0;                ///< B, Pa
  double exponent_1 = 0;                ///< R1
  double exponent_2 = 0;                ///< R2
  double gruneisen = 0;                 ///< omega
  double detonation_energy = 0;         ///< E0, J/m^3 of the explosive
  double heat_capacity = 0;             ///< c_v of the products, J/(kg K)
  double detonation_velocity = 0;       ///< D, m/s; 0: not given
  double chapman_jouguet_pressure = 0;  ///< p_CJ, Pa; 0: not given
};

/// Models detonation products after Jones, Wilkins and Lee (Lee, Hornig and Kury, UCRL-50422, 1968;
/// docs/theory/equations_of_state.md, section 2.5), v = rho0/rho:
///   p = A [1 - omega/(R1 v)] exp(-R1 v) + B [1 - omega/(R2 v)] exp(-R2 v) + omega rho e.
/// The reference state is the explosive with its heat of reaction, E0/rho0, as products.
class JwlCurve {
 public:
  using Constants = JwlConstants;
  static constexpr std::string_view name = "jwl";
  static constexpr bool detonates = true;
  static constexpr std::string_view summary = "Jones-Wilkins-Lee detonation products";
  static ParameterTable<Constants> parameters();

  /// Warns if a given detonation velocity or pressure disagrees with the constants.
  /// @throws InputError if E0 is less than the cold energy at rho0, or the products cannot detonate
  explicit JwlCurve(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return constants_.reference_density; }
  [[nodiscard]] double reference_temperature() const { return reference_temperature_; }
  [[nodiscard]] double reference_energy() const {
    return constants_.detonation_energy / constants_.reference_density;
  }
  [[nodiscard]] double reference_sound_speed() const { return reference_sound_speed_; }
  [[nodiscard]] double heat_capacity() const { return constants_.heat_capacity; }
  [[nodiscard]] bool condensed() const { return false; }
  /// Returns the density of v = 1/R1, beyond which the first exponential is no longer steep.
  [[nodiscard]] double maximum_density() const {
    return constants_.exponent_1 * constants_.reference_density;
  }
  [[nodiscard]] std::string_view phase(double, double) const { return "detonation products"; }

  [[nodiscard]] LinearIsochore isochore(Lanes rho) const {
    const Constants& k = constants_;
    const Lanes V = 1.0 / rho, v = k.reference_density * V;
    const Lanes p1 = k.pressure_1 * exp(-k.exponent_1 * v), p2 = k.pressure_2 * exp(-k.exponent_2 * v);
    // Cold curve e_c = [A/R1 exp(-R1 v) + B/R2 exp(-R2 v)]/rho0 and its p = rho^2 de_c/drho.
    const Lanes energy =
        (1 / (k.exponent_1 * k.reference_density)) * p1 + (1 / (k.exponent_2 * k.reference_density)) * p2;
    const Lanes slope = v * V * (k.exponent_1 * p1 + k.exponent_2 * p2);
    return LinearIsochore::on_curve(rho, V, k.gruneisen, p1 + p2, slope, energy, energy);
  }
  /// Returns ln(T_s/T0).
  [[nodiscard]] double log_isentrope_temperature(double rho) const;

 private:
  void check_detonation() const;

  Constants constants_;
  double reference_temperature_ = 0;
  double reference_sound_speed_ = 0;
};

using Jwl = ConstantHeatCapacity<JwlCurve>;
extern template class ConstantHeatCapacity<JwlCurve>;

}  // namespace whipple::eos

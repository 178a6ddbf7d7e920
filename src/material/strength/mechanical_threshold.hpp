// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/radial_return.hpp"
#include "src/material/strength/thermal_barrier.hpp"

namespace whipple::strength {

/// Mechanical threshold stress: flow stress of metals by thermal activation, with an evolving threshold stress of the
/// dislocations, which is a state of each point,
///   Y = sigma_a + [S_i sigma_i + S_e sigma_e] G/G0,        S_i, S_e: ThermalBarrier
///   d sigma_e/d ep = theta_0 [1 - F] + theta_IV F,         F = tanh(alpha sigma_e/sigma_es)/tanh(alpha)
///   theta_0 = a0 + a1 ln(rate) + a2 sqrt(rate) - a3 T
///   ln(sigma_es/sigma_es0) = kT/(g_es b^3 G) ln(rate/rate_es)
///   G = [G0 - D/(exp(T_0/T) - 1)] [1 + A p/eta^(1/3)],     eta = rho/rho0.
/// Source: P. S. Follansbee, U. F. Kocks, Acta Metall. 36 (1988) 81; G of temperature: Y. P. Varshni, Phys. Rev. B 2
/// (1970) 3952. The dependence of G on pressure is that of Steinberg, Cochran and Guinan. Rates are limited to the
/// range from `least_rate` to rate_es; at and above T_m there is no strength.
struct MechanicalThreshold {
  double reference_density = 0.0;         ///< rho0, kg/m^3
  double shear_modulus = 0.0;             ///< G0, Pa, at 0 K
  double modulus_drop = 0.0;              ///< D, Pa
  double modulus_temperature = 0.0;       ///< T_0, K
  double pressure_coefficient = 0.0;      ///< A, 1/Pa
  double melting_temperature = 0.0;       ///< T_m, K
  double boltzmann_per_volume = 0.0;      ///< k/b^3, Pa/K
  double athermal_stress = 0.0;           ///< sigma_a, Pa
  double intrinsic_threshold = 0.0;       ///< sigma_i, Pa
  ThermalBarrier intrinsic;               ///< of sigma_i
  ThermalBarrier forest;                  ///< of sigma_e
  double hardening = 0.0;                 ///< a0, Pa
  double hardening_by_log_rate = 0.0;     ///< a1, Pa
  double hardening_by_root_rate = 0.0;    ///< a2, Pa, of the rate in 1/s
  double hardening_by_temperature = 0.0;  ///< a3, Pa/K
  double last_hardening = 0.0;            ///< theta_IV, Pa
  double hardening_shape = 0.0;           ///< alpha
  double saturation = 0.0;                ///< sigma_es0, Pa
  double saturation_energy = 0.0;         ///< g_es
  double saturation_rate = 0.0;           ///< rate_es, 1/s
  double initial_threshold = 0.0;         ///< sigma_e of the temper, Pa

  static ParameterTable<MechanicalThreshold> parameters() {
    using P = MechanicalThreshold;
    ParameterTable<P> table = {
        real("reference_density", &P::reference_density, "kg/m^3", range::positive(), "rho0"),
        real("shear_modulus", &P::shear_modulus, "Pa", range::positive(), "G0 at 0 K and no pressure"),
        real("modulus_drop", &P::modulus_drop, "Pa", range::non_negative(), "D: G = G0 - D/[exp(T_0/T) - 1]"),
        real("modulus_temperature", &P::modulus_temperature, "K", range::positive(), "T_0"),
        real("pressure_coefficient", &P::pressure_coefficient, "1/Pa", range::non_negative(),
             "A: relative rise of G with p/eta^(1/3)")
            .optional(),
        real("melting_temperature", &P::melting_temperature, "K", range::positive(),
             "T_m: no strength at and above it"),
        real("boltzmann_per_volume", &P::boltzmann_per_volume, "Pa/K", range::positive(),
             "k/b^3: Boltzmann's constant over the cube of the Burgers vector"),
        real("athermal_stress", &P::athermal_stress, "Pa", range::non_negative(), "sigma_a"),
        real("hardening", &P::hardening, "Pa", range::positive(), "a0 of theta_0, initial rate of hardening"),
        real("hardening_by_log_rate", &P::hardening_by_log_rate, "Pa", range::non_negative(),
             "a1: rise of theta_0 with ln(rate in 1/s)")
            .optional(),
        real("hardening_by_root_rate", &P::hardening_by_root_rate, "Pa", range::non_negative(),
             "a2: rise of theta_0 with the root of the rate in 1/s")
            .optional(),
        real("hardening_by_temperature", &P::hardening_by_temperature, "Pa/K", range::non_negative(),
             "a3: fall of theta_0 with temperature")
            .optional(),
        real("last_hardening", &P::last_hardening, "Pa", range::non_negative(),
             "theta_IV: rate of hardening at saturation")
            .optional(),
        real("hardening_shape", &P::hardening_shape, "", range::positive(), "alpha"),
        real("saturation", &P::saturation, "Pa", range::positive(), "sigma_es0: of sigma_e at 0 K"),
        real("saturation_energy", &P::saturation_energy, "", range::positive(),
             "g_es: activation energy of saturation over G b^3"),
        real("saturation_rate", &P::saturation_rate, "1/s", range::positive(), "rate_es"),
        real("initial_threshold", &P::initial_threshold, "Pa", range::non_negative(),
             "sigma_e of the temper: 0 annealed")
            .optional(),
        real("intrinsic_threshold", &P::intrinsic_threshold, "Pa", range::non_negative(),
             "sigma_i: of the lattice and its solutes, at 0 K")
            .optional(),
    };
    table =
        with_part(std::move(table), &P::intrinsic, ThermalBarrier::parameters("intrinsic", "sigma_i", false));
    return with_part(std::move(table), &P::forest, ThermalBarrier::parameters("forest", "sigma_e", true));
  }
  /// Minimum rate (1/s) of the formula, the slowest of the tests behind the published constants: slower flow has the
  /// stress at this rate.
  static constexpr double least_rate = 1e-4;
  static constexpr const char* name = "mechanical_threshold";
  static constexpr const char* summary =
      "Mechanical threshold stress: metals by thermal activation, hardening as a state that evolves";
  static constexpr const char* theory =
      "Y = sigma_a + [S_i sigma_i + S_e sigma_e] G/G0, d sigma_e/d ep = theta_0 [1 - F] + theta_IV F,\n"
      "F = tanh(alpha sigma_e/sigma_es)/tanh(alpha), times the solid fraction: docs/theory/material.md.\n"
      "Source: Follansbee and Kocks, Acta Metall. 36 (1988) 81.";

  /// @throws InputError if the constants are inconsistent
  void require_consistent() const {
    if (modulus_of(1.0, melting_temperature) <= 0.0) {
      throw InputError("'modulus_drop' leaves no shear modulus below 'melting_temperature'");
    }
    if (intrinsic.given() != (intrinsic_threshold > 0.0 ? 4 : 0)) {
      throw InputError(
          "'intrinsic_threshold' and 'intrinsic_energy', '_rate', '_p' and '_q' belong together: expected "
          "all "
          "of them or none");
    }
    if (last_hardening > hardening) throw InputError("'last_hardening' is above 'hardening'");
  }
  /// Returns a temperature in K; without a temperature (NaN) of the equation of state 300 K.
  static double kelvin(double temperature) { return std::isnan(temperature) ? 300.0 : temperature; }
  /// Returns G of the solid, Pa.
  /// @param compressed  1 + A p/eta^(1/3)
  [[nodiscard]] double modulus_of(double compressed, double temperature) const {
    const double drop =
        temperature > 0.0 ? modulus_drop / std::expm1(modulus_temperature / temperature) : 0.0;
    return compressed * (shear_modulus - drop);
  }
  /// Returns G of the solid (Pa) up to the melting temperature; at least G0/1000.
  [[nodiscard]] double modulus(double density, double pressure, double temperature) const {
    const double compressed = 1.0 + pressure_coefficient * pressure / std::cbrt(density / reference_density);
    return std::max(1e-3 * shear_modulus,
                    modulus_of(compressed, std::min(kelvin(temperature), melting_temperature)));
  }

  /// Holds the variables of the stress of a point other than its threshold and its rate.
  struct Condition {
    double temperature;  ///< K
    double thermal;      ///< kT/(b^3 G)
    double stiffness;    ///< G/G0
  };
  [[nodiscard]] Condition condition(double temperature, double modulus) const {
    const double T = kelvin(temperature);
    return {T, boltzmann_per_volume * T / modulus, modulus / shear_modulus};
  }
  /// Returns the logarithm of a rate, limited to the range of the formula.
  [[nodiscard]] double log_rate(double rate) const {
    return std::log(std::clamp(rate, least_rate, std::max(least_rate, saturation_rate)));
  }
  /// Returns sigma_es, Pa.
  [[nodiscard]] double saturation_of(double log_rate, const Condition& at) const {
    return saturation * std::exp(at.thermal / saturation_energy * (log_rate - std::log(saturation_rate)));
  }
  /// Returns sigma_e after a plastic strain x at constant rate and temperature, and its derivative with respect to x at
  /// constant rate. The hardening is linearised about its beginning and solved exactly: of second order in x; without
  /// theta_IV never beyond saturation.
  [[nodiscard]] FlowStress threshold(double before, double x, double log_rate, const Condition& at) const {
    const double initial = std::max(0.0, hardening + hardening_by_log_rate * log_rate +
                                             hardening_by_root_rate * std::exp(0.5 * log_rate) -
                                             hardening_by_temperature * at.temperature);
    const double last = std::min(last_hardening, initial);
    const double end = saturation_of(log_rate, at);
    const double whole = std::tanh(hardening_shape), now = std::tanh(hardening_shape * before / end);
    const double slope = initial - (initial - last) * now / whole;
    // Derivative of the slope
    const double bend = -(initial - last) * hardening_shape * (1.0 - now * now) / (end * whole);
    const double path = bend * x, mean = std::abs(path) > 1e-12 ? std::expm1(path) / path : 1.0;
    const double after = before + slope * mean * x;
    if (slope < 0.0 && after < end) return {std::min(before, end), 0.0};  // softens to saturation
    return {after, slope * std::exp(path)};
  }
  /// Returns a lower bound of Y for all strains of a step: the stress of the slowest flow, softened to its saturation.
  [[nodiscard]] double least_flow(double before, const Condition& at) const {
    const double slowest = std::log(least_rate);
    double stress = forest.passed(at.thermal, slowest).value * std::min(before, saturation_of(slowest, at));
    if (intrinsic_threshold > 0.0)
      stress += intrinsic.passed(at.thermal, slowest).value * intrinsic_threshold;
    return athermal_stress + at.stiffness * stress;
  }
  /// Returns Y of the solid and its derivative with respect to x at the plastic strain x reached in dt from the
  /// threshold `before`.
  [[nodiscard]] FlowStress flow(double before, double x, double dt, const Condition& at) const {
    const double rate = x / dt, log = log_rate(rate);
    const FlowStress hardened = threshold(before, x, log, at), passed = forest.passed(at.thermal, log);
    const bool counts = rate > least_rate && rate < saturation_rate;
    double stress = passed.value * hardened.value;
    double slope = passed.value * hardened.slope + (counts ? passed.slope * hardened.value / x : 0.0);
    if (intrinsic_threshold > 0.0) {
      const FlowStress lattice = intrinsic.passed(at.thermal, log);
      stress += lattice.value * intrinsic_threshold;
      if (counts) slope += lattice.slope * intrinsic_threshold / x;
    }
    return {athermal_stress + at.stiffness * stress, at.stiffness * slope};
  }
};

}  // namespace whipple::strength

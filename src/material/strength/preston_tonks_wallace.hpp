// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <string_view>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/radial_return.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// Preston-Tonks-Wallace: flow stress of metals from 1e-3 to 1e12 1/s, thermal activation at ordinary rates,
/// dislocation drag in strong shocks. With T^ = T/T_m and r = rate/(gamma Xi), Xi = (1/2) (4 pi rho/(3 m))^(1/3)
/// (G/rho)^(1/2) of the atomic mass m,
///   G     = G0 [1 + A p/eta^(1/3)] (1 - alpha T^),  eta = rho/rho0,
///   tau_s = max{s0 - (s0 - s_inf) erf[kappa T^ ln(1/r)], s0 r^beta}                              saturation
///   tau_y = max{y0 - (y0 - y_inf) erf[kappa T^ ln(1/r)], min[y1 r^y2, s0 r^beta]}                yield
///   tau   = tau_s + (s0 - tau_y)/p ln{1 - [1 - exp(-a)] exp[-p theta e/((s0 - tau_y)(exp(a) - 1))]},
///           a = p (tau_s - tau_y)/(s0 - tau_y),                      e = ep + ep_i
///   tau   = tau_s - (tau_s - tau_y) exp[-theta e/(tau_s - tau_y)]                                where p = 0
///   Y     = 2 tau G.
/// Source: D. L. Preston, D. L. Tonks, D. C. Wallace, J. Appl. Phys. 93 (2003) 211. The dependence of G on pressure is
/// that of Steinberg, Cochran and Guinan; T_m is constant; ep_i, the plastic strain of a cold-worked temper, is this
/// project's addition.
struct PrestonTonksWallace {
  double reference_density = 0.0;       ///< rho0, kg/m^3
  double shear_modulus = 0.0;           ///< G0, Pa, at 0 K
  double thermal_softening = 0.0;       ///< alpha
  double pressure_coefficient = 0.0;    ///< A, 1/Pa
  double melting_temperature = 0.0;     ///< T_m, K
  double molar_mass = 0.0;              ///< kg/mol
  double hardening = 0.0;               ///< theta
  double hardening_shape = 0.0;         ///< p
  double cold_saturation = 0.0;         ///< s0
  double hot_saturation = 0.0;          ///< s_inf
  double cold_yield = 0.0;              ///< y0
  double hot_yield = 0.0;               ///< y_inf
  double activation = 0.0;              ///< kappa
  double attempt_rate = 0.0;            ///< gamma
  double medium_rate_stress = 0.0;      ///< y1
  double medium_rate_exponent = 0.0;    ///< y2
  double drag_exponent = 0.0;           ///< beta
  double initial_plastic_strain = 0.0;  ///< ep_i

  static ParameterTable<PrestonTonksWallace> parameters() {
    using P = PrestonTonksWallace;
    return {
        real("reference_density", &P::reference_density, "kg/m^3", range::positive(), "rho0"),
        real("shear_modulus", &P::shear_modulus, "Pa", range::positive(), "G0 at 0 K and no pressure"),
        real("thermal_softening", &P::thermal_softening, "", range::open_between(0.0, 1.0),
             "alpha: G falls to G0 (1 - alpha) at the melting temperature"),
        real("pressure_coefficient", &P::pressure_coefficient, "1/Pa", range::non_negative(),
             "A: relative rise of G with p/eta^(1/3)")
            .optional(),
        real("melting_temperature", &P::melting_temperature, "K", range::positive(), "T_m"),
        real("molar_mass", &P::molar_mass, "kg/mol", range::positive(), "mean of the atoms"),
        real("hardening", &P::hardening, "", range::non_negative(), "theta, initial rate of hardening"),
        real("hardening_shape", &P::hardening_shape, "", range::non_negative(), "p; 0: Voce's law"),
        real("cold_saturation", &P::cold_saturation, "", range::positive(), "s0: of tau_s at 0 K, over G"),
        real("hot_saturation", &P::hot_saturation, "", range::non_negative(),
             "s_inf: of tau_s near melting, over G"),
        real("cold_yield", &P::cold_yield, "", range::non_negative(), "y0: of tau_y at 0 K, over G"),
        real("hot_yield", &P::hot_yield, "", range::non_negative(), "y_inf: of tau_y near melting, over G"),
        real("activation", &P::activation, "", range::positive(), "kappa, of temperature and rate"),
        real("attempt_rate", &P::attempt_rate, "", range::positive(),
             "gamma: rate of the attempts over the frequency of the atoms"),
        real("medium_rate_stress", &P::medium_rate_stress, "", range::non_negative(),
             "y1: of tau_y at rates of 1e4 to 1e8 1/s"),
        real("medium_rate_exponent", &P::medium_rate_exponent, "", range::positive(), "y2"),
        real("drag_exponent", &P::drag_exponent, "", range::positive(), "beta, of strong shocks"),
        real("initial_plastic_strain", &P::initial_plastic_strain, "", range::non_negative(),
             "ep_i: cold work of the temper")
            .optional(),
    };
  }
  /// Minimum rate (1/s) of the formula: slower flow has the stress at this rate.
  static constexpr double least_rate = 1e-3;
  static constexpr const char* name = "preston_tonks_wallace";
  static constexpr const char* summary =
      "Preston-Tonks-Wallace: metals from quasi-static rates to strong shocks";
  static constexpr const char* theory =
      "Y = 2 tau G, G = G0 [1 + A p/eta^(1/3)] (1 - alpha T^), T^ = T/T_m, both times the solid fraction;\n"
      "tau from tau_y to tau_s with the plastic strain: docs/theory/material.md.\n"
      "Source: Preston, Tonks and Wallace, J. Appl. Phys. 93 (2003) 211.";

  /// @throws InputError if the constants are inconsistent
  void require_consistent() const {
    if (hot_saturation > cold_saturation) throw InputError("'hot_saturation' is above 'cold_saturation'");
    if (hot_yield > cold_yield) throw InputError("'hot_yield' is above 'cold_yield'");
    if (cold_yield > cold_saturation) throw InputError("'cold_yield' is above 'cold_saturation'");
    if (hot_yield > hot_saturation) throw InputError("'hot_yield' is above 'hot_saturation'");
  }
  /// Returns T^ in [0, 1]; without a temperature (NaN) of the equation of state that of 300 K.
  [[nodiscard]] double homologous(double temperature) const {
    return std::clamp((std::isnan(temperature) ? 300.0 : temperature) / melting_temperature, 0.0, 1.0);
  }
  /// Returns G of the solid, Pa; at least G0/1000.
  [[nodiscard]] double modulus(double density, double pressure, double temperature) const {
    const double compressed = 1.0 + pressure_coefficient * pressure / std::cbrt(density / reference_density);
    return shear_modulus * std::max(1e-3, compressed * (1.0 - thermal_softening * homologous(temperature)));
  }
  /// Returns gamma Xi, 1/s.
  [[nodiscard]] double frequency(double density, double modulus) const {
    constexpr double avogadro = 6.02214076e23;  // 1/mol
    const double atoms = density * avogadro / molar_mass;
    return attempt_rate * 0.5 * std::cbrt(4.0 / 3.0 * std::numbers::pi * atoms) *
           std::sqrt(modulus / density);
  }
  /// Returns Y of the solid and its derivative with respect to x at the plastic strain ep0 + x reached in dt.
  [[nodiscard]] FlowStress flow(double plastic_strain, double x, double dt, double homologous, double modulus,
                                double frequency) const {
    const double rate = std::max(x / dt, least_rate), r = rate / frequency, lag = -std::log(r);
    const double argument = activation * homologous * lag, activated = std::erf(argument);
    const double by_log =
        2.0 / std::sqrt(std::numbers::pi) * std::exp(-argument * argument) * activation * homologous;
    const double drag = cold_saturation * std::pow(r, drag_exponent),
                 medium = medium_rate_stress * std::pow(r, medium_rate_exponent);
    double saturation = cold_saturation - (cold_saturation - hot_saturation) * activated,
           saturation_by_log = (cold_saturation - hot_saturation) * by_log;
    if (drag > saturation) {
      saturation = drag;
      saturation_by_log = drag_exponent * drag;
    }
    double yield = cold_yield - (cold_yield - hot_yield) * activated,
           yield_by_log = (cold_yield - hot_yield) * by_log;
    if (const double fast = std::min(medium, drag); fast > yield) {
      yield = fast;
      yield_by_log = (medium < drag ? medium_rate_exponent : drag_exponent) * fast;
    }
    const double span = saturation - yield, room = cold_saturation - yield;
    double tau = saturation, by_strain = 0.0, by_saturation = 1.0, by_yield = 0.0;
    const double strain = plastic_strain + x + initial_plastic_strain;
    if (span > 1e-9 * saturation && room > 0.0 && hardening_shape > 0.0) {
      const double a = hardening_shape * span / room, growth = std::expm1(a);
      const double hardened = hardening_shape * hardening * strain / (room * growth);
      const double left = -std::expm1(-a) * std::exp(-hardened), odds = left / (1.0 - left);
      // Derivative of ln(left) with respect to a
      const double by_a = (1.0 + hardened * (growth + 1.0)) / growth;
      tau = saturation + room / hardening_shape * std::log1p(-left);
      by_strain = hardening * odds / growth;
      by_saturation = 1.0 - odds * by_a;
      by_yield = -std::log1p(-left) / hardening_shape +
                 odds * (by_a * (cold_saturation - saturation) / room + hardened / hardening_shape);
    } else if (span > 1e-9 * saturation && room > 0.0) {
      const double hardened = hardening * strain / span, left = std::exp(-hardened);
      tau = saturation - span * left;
      by_strain = hardening * left;
      by_yield = left * (1.0 + hardened);
      by_saturation = 1.0 - by_yield;
    }
    const double by_log_rate = by_saturation * saturation_by_log + by_yield * yield_by_log;
    return {2.0 * modulus * tau, 2.0 * modulus * (by_strain + (x / dt > least_rate ? by_log_rate / x : 0.0))};
  }
};

class PrestonTonksWallaceModel final : public Strength {
 public:
  /// @throws InputError if the constants are inconsistent
  explicit PrestonTonksWallaceModel(const PrestonTonksWallace& constants) : constants_(constants) {
    constants.require_consistent();
  }

  [[nodiscard]] std::string_view model() const override { return PrestonTonksWallace::name; }
  void shear_modulus(const State& state, std::span<double> modulus) const override {
    for (std::size_t i = 0; i < modulus.size(); ++i) modulus[i] = modulus_of(state, i);
  }
  void plastic_increment(const State& state, std::span<const double> trial, std::span<const double> modulus,
                         std::span<const double> solid_fraction, double dt,
                         std::span<double> increment) const override {
    for (std::size_t i = 0; i < increment.size(); ++i) {
      const double solid = solid_fraction[i], of_solid = modulus[i] / solid;
      // Y is never below that of fully activated flow: avoids the formula for most elastic points.
      if (trial[i] <= 2.0 * modulus[i] * constants_.hot_yield) {
        increment[i] = 0.0;
        continue;
      }
      const double homologous = constants_.homologous(state.temperature[i]),
                   frequency = constants_.frequency(state.density[i], of_solid);
      const auto flow = [&](double x) {
        return constants_.flow(state.plastic_strain[i], x, dt, homologous, of_solid, frequency);
      };
      increment[i] = radial_return(trial[i], modulus[i], solid, flow(no_strain).value, flow);
    }
  }
  void flow_stress(const State& state, std::span<const double> rate,
                   std::span<double> stress) const override {
    for (std::size_t i = 0; i < stress.size(); ++i) {
      const double modulus = modulus_of(state, i);
      stress[i] = constants_
                      .flow(state.plastic_strain[i], no_strain, no_strain / std::max(rate[i], 1e-300),
                            constants_.homologous(state.temperature[i]), modulus,
                            constants_.frequency(state.density[i], modulus))
                      .value;
    }
  }
  [[nodiscard]] std::string constants() const override {
    PrestonTonksWallace copy = constants_;
    return fmt::format("model = \"{}\"\n{}", PrestonTonksWallace::name,
                       to_toml(whipple::bind(PrestonTonksWallace::parameters(), copy)));
  }

 private:
  static constexpr double no_strain = 1e-30;
  [[nodiscard]] double modulus_of(const State& state, std::size_t i) const {
    return constants_.modulus(state.density[i], state.pressure[i], state.temperature[i]);
  }
  PrestonTonksWallace constants_;
};

}  // namespace whipple::strength

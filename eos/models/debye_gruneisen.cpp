// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md, "Debye-Grueneisen solid".
#include "eos/models/debye_gruneisen.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "eos/models/debye_function.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double molar_gas_constant = 8.314462618;  ///< J/(mol K), CODATA 2018
constexpr double greatest_volume_ratio = 3.0;       ///< of V/V0
constexpr double least_volume_ratio = 0.2;

}  // namespace

ParameterTable<DebyeGruneisenConstants> DebyeGruneisen::phase_parameters() {
  using C = DebyeGruneisenConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(),
           "rho0, density at the reference temperature and zero pressure"),
      choice("isotherm", &C::isotherm,
             "form of the isotherm of the reference temperature (Birch-Murnaghan: third order)")
          .optional(),
      real("bulk_modulus", &C::bulk_modulus, "Pa", range::positive(),
           "K0, isothermal, at the reference temperature and rho0"),
      real("bulk_modulus_slope", &C::bulk_modulus_slope, "", {.lower = 1.0, .lower_open = true},
           "K0' = dK_T/dp of that isotherm at rho0"),
      real("debye_temperature", &C::debye_temperature, "K", range::positive(), "theta0 at rho0"),
      real("gruneisen", &C::gruneisen, "", range::positive(), "gamma0 of the lattice at rho0"),
      choice("gruneisen_law", &C::gruneisen_law, "gamma0 (V/V0)^q, or gamma0 - a (1 - V/V0)").optional(),
      real("gruneisen_exponent", &C::gruneisen_exponent, "", range::between(-3.0, 5.0),
           "q of the law \"power\"")
          .optional(),
      real("gruneisen_slope", &C::gruneisen_slope, "", range::any(), "a of the law \"linear\"").optional(),
      real("electronic_heat_coefficient", &C::electronic_heat_coefficient, "J/(mol K^2)",
           range::non_negative(), "g_e of the electronic heat capacity g_e T at rho0")
          .optional(),
      real("electronic_gruneisen", &C::electronic_gruneisen, "", range::any(),
           "gamma_e of the electrons: g_e (V/V0)^gamma_e")
          .optional()};
}

ParameterTable<DebyeGruneisenConstants> DebyeGruneisen::parameters() {
  using C = DebyeGruneisenConstants;
  ParameterTable<C> table = {real("molar_mass", &C::molar_mass, "kg/mol", range::positive(),
                                  "mass of a mole of atoms (compounds: the mean over the atoms)")};
  table.append(phase_parameters());
  table.append(
      {real("reference_temperature", &C::reference_temperature, "K", range::positive(),
            "T0, temperature of the isotherm")
           .optional(),
       real("melting_temperature", &C::melting_temperature, "K", range::positive(),
            "T_m0, melting temperature on the isochore of rho0 (not at zero pressure), for Lindemann's law")
           .optional("none: never melts")});
  return table;
}

/// Holds quantities that depend on the volume alone.
struct DebyeGruneisen::Isochore {
  double volume = 0;                          ///< m^3/kg
  double log_ratio = 0;                       ///< ln(V/V0)
  double debye_temperature = 0;               ///< K
  double gruneisen = 0, gruneisen_slope = 0;  ///< gamma, dgamma/dlnV
  double electronic = 0;                      ///< g_e (V/V0)^gamma_e per unit mass, J/(kg K^2)
  // From F_0(V) - F_th(V, T0), added to the thermal part of a state.
  double energy = 0;    ///< J/kg
  double pressure = 0;  ///< P V, J/kg
  double modulus = 0;   ///< K_T V, J/kg
};

/// Holds functions of y = theta/T for the lattice, each evaluated once.
struct DebyeGruneisen::Vibration {
  explicit Vibration(double y) : ratio(y), debye(debye_function(y)), filling(-std::expm1(-y)) {}
  double ratio;    ///< y
  double debye;    ///< D(y)
  double filling;  ///< 1 - e^-y
  /// Returns C_D/(3 R) = 4 D - 3 y/(e^y - 1).
  [[nodiscard]] double heat_capacity() const { return 4 * debye - 3 * ratio * (1 - filling) / filling; }
};

/// Holds the thermal part of a state (D4 to D6), J/kg and J/(kg K).
struct DebyeGruneisen::Thermal {
  double temperature = 0;
  double energy = 0, heat_capacity = 0;
  double pressure = 0;                 ///< P V
  double pressure_by_temperature = 0;  ///< V (dP/dT)_V
  double modulus = 0;                  ///< -V^2 (dP/dV)_T
};

/// Holds one point.
struct DebyeGruneisen::Point {
  double density = 0, energy = 0, temperature = 0, pressure = 0;
  double squared_sound_speed = 0, heat_capacity = 0, gruneisen = 0, bulk_modulus = 0;
  bool melted = false, cold = false;
  std::string_view broken;
};

DebyeGruneisen::DebyeGruneisen(const Constants& constants)
    : constants_(constants),
      vinet_(constants.isotherm == IsothermForm::vinet),
      power_law_(constants.gruneisen_law == LatticeGruneisenLaw::power),
      gas_constant_(molar_gas_constant / constants.molar_mass),
      least_squared_sound_speed_(least_sound_speed_ratio * least_sound_speed_ratio * constants.bulk_modulus /
                                 constants.reference_density) {
  if (power_law_ ? constants.gruneisen_slope != 0 : constants.gruneisen_exponent != 1) {
    throw InputError(fmt::format("debye_gruneisen: {} does not belong to gruneisen_law = \"{}\"",
                                 power_law_ ? "gruneisen_slope" : "gruneisen_exponent",
                                 word_of(constants.gruneisen_law)));
  }
  // The energy at (V0, T0) is F_0(V0) + T0 S(V0, T0).
  const double T0 = constants.reference_temperature;
  const Isochore reference = lattice(constants.reference_density);
  reference_free_energy_ = -T0 * entropy(reference, T0, Vibration(reference.debye_temperature / T0));
  find_limits();
}

void DebyeGruneisen::find_limits() {
  const double rho0 = constants_.reference_density;
  constexpr int steps = 2000;
  const auto sound = [&](double density, bool compressed) {
    const Isochore cold = isochore(density);
    return cold.gruneisen > 0 && (!compressed || cold.modulus + thermal(cold, least_temperature).modulus > 0);
  };
  maximum_density_ = minimum_density_ = rho0;
  for (int i = 1; i <= steps; ++i) {
    const double density = rho0 / (1 - (1 - least_volume_ratio) * i / steps);
    if (!sound(density, true)) break;
    maximum_density_ = density;
  }
  for (int i = 1; i <= steps; ++i) {
    const double density = rho0 / (1 + (greatest_volume_ratio - 1) * i / steps);
    if (!sound(density, false)) break;
    minimum_density_ = density;
  }
  if (maximum_density_ < 1.01 * rho0) {
    throw InputError(
        fmt::format("debye_gruneisen: the cold curve or the Grueneisen parameter turns over at {:.4g} "
                    "kg/m^3, at no compression to speak of; check bulk_modulus_slope ({:.4g}), gruneisen "
                    "({:.4g}) and the law of it",
                    maximum_density_, constants_.bulk_modulus_slope, constants_.gruneisen));
  }
}

DebyeGruneisen::Isochore DebyeGruneisen::lattice(double density) const {
  const Constants& k = constants_;
  Isochore c;
  c.volume = 1 / density;
  const double ratio = k.reference_density / density;
  c.log_ratio = std::log(ratio);
  double exponent = 0;  // ln(theta/theta0)
  if (power_law_) {     // (D2)
    const double q = k.gruneisen_exponent, change = std::expm1(q * c.log_ratio);
    c.gruneisen = k.gruneisen * (1 + change);
    c.gruneisen_slope = q * c.gruneisen;
    exponent = -k.gruneisen * (q == 0 ? c.log_ratio : change / q);
  } else {  // (D3)
    c.gruneisen = k.gruneisen - k.gruneisen_slope * (1 - ratio);
    c.gruneisen_slope = k.gruneisen_slope * ratio;
    exponent = -(k.gruneisen - k.gruneisen_slope) * c.log_ratio + k.gruneisen_slope * (1 - ratio);
  }
  c.debye_temperature = k.debye_temperature * std::exp(exponent);
  if (k.electronic_heat_coefficient > 0) {
    c.electronic =
        k.electronic_heat_coefficient / k.molar_mass * std::exp(k.electronic_gruneisen * c.log_ratio);
  }
  return c;
}

DebyeGruneisen::Isochore DebyeGruneisen::isochore(double density) const {
  const Constants& k = constants_;
  const double K0 = k.bulk_modulus, slope = k.bulk_modulus_slope, V0 = 1 / k.reference_density;
  Isochore c = lattice(density);
  double pressure = 0, modulus = 0, work = 0;  // work: -integral of P dV from V0
  if (vinet_) {                                // (D7)
    const double X = std::exp(c.log_ratio / 3), y = 1 - X, eta = 1.5 * (slope - 1);
    const double factor = std::exp(eta * y);
    pressure = 3 * K0 / (X * X) * y * factor;
    modulus = K0 / (X * X) * (1 + y + eta * X * y) * factor;
    work = 9 * K0 * V0 / (eta * eta) * (1 - (1 - eta * y) * factor);
  } else {  // (D8)
    const double f = 0.5 * std::expm1(-2.0 / 3.0 * c.log_ratio), half = slope - 4;
    const double power = (1 + 2 * f) * (1 + 2 * f) * std::sqrt(1 + 2 * f);
    pressure = 3 * K0 * f * power * (1 + 1.5 * half * f);
    modulus = K0 * power * (1 + (3 * slope - 5) * f + 13.5 * half * f * f);
    work = 4.5 * K0 * V0 * f * f * (1 + half * f);
  }
  const double T0 = k.reference_temperature;
  const Vibration vibration(c.debye_temperature / T0);
  const Thermal reference = thermal(c, T0, vibration);
  c.energy = reference_free_energy_ + work - reference.energy + T0 * entropy(c, T0, vibration);
  c.pressure = pressure * c.volume - reference.pressure;
  c.modulus = modulus * c.volume - reference.modulus;
  return c;
}

DebyeGruneisen::Thermal DebyeGruneisen::thermal(const Isochore& c, double T, const Vibration& v) const {
  const double R3 = 3 * gas_constant_;
  const double energy = R3 * T * v.debye;          // (D4)
  const double capacity = R3 * v.heat_capacity();  // (D5)
  const double electrons = 0.5 * c.electronic * T * T;
  const double gamma = c.gruneisen, gamma_e = constants_.electronic_gruneisen;
  Thermal t;
  t.temperature = T;
  t.energy = energy + electrons;
  t.heat_capacity = capacity + c.electronic * T;
  t.pressure = gamma * energy + gamma_e * electrons;
  t.pressure_by_temperature = gamma * capacity + gamma_e * c.electronic * T;
  t.modulus = energy * (gamma * (1 + gamma) - c.gruneisen_slope) - gamma * gamma * T * capacity +
              gamma_e * (1 - gamma_e) * electrons;  // (D6)
  return t;
}

DebyeGruneisen::Thermal DebyeGruneisen::thermal(const Isochore& c, double T) const {
  return thermal(c, T, Vibration(c.debye_temperature / T));
}

double DebyeGruneisen::entropy(const Isochore& c, double T, const Vibration& v) const {
  return gas_constant_ * (4 * v.debye - 3 * std::log(v.filling)) + c.electronic * T;
}

DebyeGruneisen::Thermal DebyeGruneisen::thermal_at_energy(const Isochore& c, double thermal_energy) const {
  // The thermal energy is convex in T (its heat capacity increases): from the right of the root Newton's method
  // converges monotonically, from the left it overshoots once. D = 1 - 3y/8 + y^2/20 gives the initial value.
  const double R3 = 3 * gas_constant_, w = thermal_energy + 0.375 * R3 * c.debye_temperature;
  const double right = 2 * w / (R3 + std::sqrt(R3 * R3 + 2 * c.electronic * w));
  double T = std::max(0.5 * right, right - c.debye_temperature * c.debye_temperature / (20 * right));
  for (int i = 0; i < 100; ++i) {
    const Vibration v(c.debye_temperature / T);
    const double step = (T * (R3 * v.debye + 0.5 * c.electronic * T) - thermal_energy) /
                        (R3 * v.heat_capacity() + c.electronic * T);
    T -= step;
    if (!(std::abs(step) > 1e-8 * T)) break;  // the next step would be below 1e-15
  }
  return thermal(c, T);
}

std::string_view DebyeGruneisen::broken_bound(double density) const {
  if (!(density > 0) || !std::isfinite(density)) return "density must be positive and finite";
  if (density > maximum_density_) return "density above the compression limit";
  if (density < minimum_density_) return "density below the expansion limit of the solid";
  return {};
}

void DebyeGruneisen::complete(Point& p, const Isochore& c, const Thermal& t) const {
  p.temperature = t.temperature;
  p.pressure = (c.pressure + t.pressure) * p.density;
  p.heat_capacity = t.heat_capacity;
  p.gruneisen = t.pressure_by_temperature / t.heat_capacity;
  p.bulk_modulus = (c.modulus + t.modulus) * p.density;
  p.squared_sound_speed =
      c.modulus + t.modulus + t.temperature * t.pressure_by_temperature * p.gruneisen;  // (D9)
  p.melted = std::isfinite(constants_.melting_temperature) && t.temperature > melting_temperature(p.density);
}

DebyeGruneisen::Point DebyeGruneisen::point(double density, double energy) const {
  Point p;
  p.density = density;
  p.energy = energy;
  p.broken = broken_bound(density);
  if (p.broken.empty() && !std::isfinite(energy)) p.broken = "specific internal energy must be finite";
  if (!p.broken.empty()) return p;
  const Isochore c = isochore(density);
  const double thermal_energy = energy - c.energy;
  // D <= 1 gives an upper bound of the energy at the lowest temperature without evaluating it.
  if (thermal_energy < (3 * gas_constant_ + c.electronic) * least_temperature) {
    const Thermal coldest = thermal(c, least_temperature);
    p.cold = thermal_energy < coldest.energy;
    if (p.cold) {
      complete(p, c, coldest);
      return p;
    }
  }
  complete(p, c, thermal_at_energy(c, thermal_energy));
  return p;
}

DebyeGruneisen::Point DebyeGruneisen::point_at_temperature(double density, double T) const {
  Point p;
  p.density = density;
  p.broken = broken_bound(density);
  if (!p.broken.empty()) return p;
  const Isochore c = isochore(density);
  const Thermal t = thermal(c, T);
  p.energy = c.energy + t.energy;
  complete(p, c, t);
  return p;
}

RangeReport DebyeGruneisen::evaluate(const Batch& batch) const {
  RangeReport report;
  for (std::size_t i = 0; i < batch.density.size(); ++i) {
    const Point p = point(batch.density[i], batch.specific_internal_energy[i]);
    if (!p.broken.empty()) {
      if (report.out_of_range++ == 0) {
        report.first = i;
        report.bound = p.broken;
      }
      batch.pressure[i] = batch.temperature[i] = batch.sound_speed[i] = State::unknown;
      continue;
    }
    report.below_cold_curve += p.cold ? 1 : 0;
    batch.pressure[i] = p.pressure;
    batch.temperature[i] = p.temperature;
    batch.sound_speed[i] = std::sqrt(std::max(p.squared_sound_speed, least_squared_sound_speed_));
    if (!batch.melted_fraction.empty()) batch.melted_fraction[i] = p.melted ? 1.0 : 0.0;
  }
  std::ranges::fill(batch.vaporised_fraction, 0.0);
  return report;
}

State DebyeGruneisen::full_state(const Point& p) const {
  if (!p.broken.empty()) {
    throw StateError(
        fmt::format("debye_gruneisen: {} (density {:.6g} kg/m^3, valid from {:.6g} to {:.6g} kg/m^3, "
                    "specific internal energy {:.6g} J/kg)",
                    p.broken, p.density, minimum_density_, maximum_density_, p.energy));
  }
  State s;
  s.density = p.density;
  s.specific_internal_energy = p.energy;
  s.temperature = p.temperature;
  s.pressure = p.pressure;
  s.sound_speed = std::sqrt(std::max(p.squared_sound_speed, least_squared_sound_speed_));
  const Isochore c = lattice(p.density);
  s.specific_entropy = entropy(c, p.temperature, Vibration(c.debye_temperature / p.temperature));
  s.heat_capacity = p.heat_capacity;
  s.gruneisen = p.gruneisen;
  s.isothermal_bulk_modulus = p.bulk_modulus;
  s.melted_fraction = p.melted ? 1.0 : 0.0;
  s.phase = p.melted ? "liquid" : "solid";
  return s;
}

State DebyeGruneisen::state(double density, double specific_internal_energy) const {
  return full_state(point(density, specific_internal_energy));
}

State DebyeGruneisen::state_at_temperature(double density, double temperature) const {
  if (!(temperature >= least_temperature) || !std::isfinite(temperature)) {
    throw StateError(fmt::format("debye_gruneisen: temperature must be finite and at least {} K, not {}",
                                 least_temperature, temperature));
  }
  return full_state(point_at_temperature(density, temperature));
}

double DebyeGruneisen::debye_temperature(double density) const { return lattice(density).debye_temperature; }

double DebyeGruneisen::melting_temperature(double density) const {
  const Isochore c = lattice(density);
  const double ratio = c.debye_temperature / constants_.debye_temperature;
  return constants_.melting_temperature * std::exp(2.0 / 3.0 * c.log_ratio) * ratio * ratio;  // (D10)
}

}  // namespace whipple::eos

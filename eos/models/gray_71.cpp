// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/gray.md, sections 2 to 4 and 8.
#include "eos/models/gray_71.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "eos/models/gray_reference_pressure.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double pole_margin = 0.03;
constexpr double greatest_compression = 0.9;
/// Relative step of the central differences along V: error 1e-10 of the slopes.
constexpr double difference = 1e-5;

}  // namespace

ParameterTable<GrayConstants> Gray71::parameters() {
  static constexpr std::array<std::string_view, 6> absent = {
      "hugoniot_quadratic",   "hugoniot_cubic",     "melting", "vapour",
      "critical_temperature", "boiling_temperature"};
  ParameterTable<GrayConstants> table = gray_parameters();
  table.remove_if(
      [](const ParameterInfo& info) { return std::ranges::find(absent, info.name) != absent.end(); });
  return table;
}

/// Holds one point in a known phase.
struct Gray71::Point {
  double V = 0, E = 0, T = 0, P = 0;
  double squared_sound_speed = 0, gruneisen = 0, heat_capacity = 0, isothermal_bulk_modulus = 0;
  double melted_fraction = 0;
  Phase phase = Phase::solid;
  bool cold = false;
  std::string_view broken;
};

Gray71::Gray71(const Constants& constants) : constants_(resolved(constants)) {
  const GrayConstants& c = constants_;
  gas_ = GrayConstants::gas_constant / c.molar_mass;
  lattice_ = 3 * gas_;
  heat_coefficient_ = (c.electronic_heat_coefficient + c.anharmonic_heat_coefficient) / c.molar_mass;
  melting_entropy_ = c.melting_entropy / c.molar_mass;
  liquid_slope_ = c.liquid_heat_coefficient / c.molar_mass;
  const double T0 = c.reference_temperature, V0 = c.reference_specific_volume;
  cold_energy_at_reference_ = -T0 * (lattice_ + heat_coefficient_ * T0 / 2);                       // (G4)
  cold_offset_ = T0 * T0 * heat_coefficient_ * (c.gruneisen - c.electronic_gruneisen) / (2 * V0);  // (G6)
  join_volume_ = c.join_volume_ratio * V0;
  // Compression limit as in gray: the cold pressure turns over or the pole is near.
  const double last = ShockCurve{c.hugoniot_slope}.limit(pole_margin, greatest_compression);
  constexpr int steps = 2000;
  least_volume_ = V0;
  double before = -INFINITY;
  for (int i = 0; i <= steps; ++i) {
    const double V = V0 * (1 - last * i / steps), cold = branch(Phase::solid, V).p0;
    if (cold <= before) break;
    before = cold;
    least_volume_ = V;
  }
  for (const Phase phase : {Phase::solid, Phase::hot_liquid, Phase::vapour}) {
    const double V = phase == Phase::vapour ? 1e3 * join_volume_ : V0;
    if (const GrayBranch b = branch(phase, V); !(b.e1 > 0)) {
      throw InputError(fmt::format(
          "gray_71: the heat capacity is {:.4g} J/(kg K) at V/V0 = {:.4g}; check hot_liquid_ratio "
          "({:.4g}) and liquid_heat_coefficient ({:.4g} J/(mol K))",
          b.e1, V / V0, c.hot_liquid_ratio, c.liquid_heat_coefficient));
    }
  }
}

double Gray71::melting_temperature(double V) const {  // (G13)
  const GrayConstants& c = constants_;
  const double x = 1 - V / c.reference_specific_volume;
  const double g = c.melting_gruneisen, a = c.melting_gruneisen_slope;
  if (x >= 0) {
    return c.melting_temperature *
           (1 + x * ((2 * g - 2.0 / 3) + x * ((g - 1.0 / 3) * (2 * g + 1.0 / 3) - a)));
  }
  return c.melting_temperature * (1 + x * (2 * (g - 4.0 / 3) + x * ((2 * g - 5.0 / 3) * (g - 4.0 / 3) - a))) /
         ((1 - x) * (1 - x));
}

double Gray71::lindemann_exponent(double V) const {  // (G12)
  const GrayConstants& c = constants_;
  return 2.0 / 3 - 2 * c.melting_gruneisen +
         2 * c.melting_gruneisen_slope * (1 - V / c.reference_specific_volume);
}

GrayBranch Gray71::branch(Phase phase, double V) const {
  const GrayConstants& c = constants_;
  if (phase == Phase::vapour) return gray_vapour_branch(c, branch(Phase::hot_liquid, join_volume_), V);
  const double V0 = c.reference_specific_volume, x = 1 - V / V0, S = c.hugoniot_slope;
  const double gamma = c.gruneisen - c.gruneisen_slope * x;  // (G2)
  const double C2 = c.hugoniot_intercept * c.hugoniot_intercept;
  const double cold = C2 * x * x / (2 * (1 - S * x)) * (1 + S * x / 3 + S * (S - c.gruneisen) * x * x / 6) +
                      cold_energy_at_reference_ * (1 + c.gruneisen * x);  // (G7), less E_0H
  const double reference =
      C2 / V0 * gray_reference_pressure(x, ShockCurve{S}, c.gruneisen, c.gruneisen_slope).value;  // (G5)
  GrayBranch b;  // (G1), (G3)
  b.e0 = c.reference_energy + cold;
  b.e1 = lattice_;
  b.e2 = heat_coefficient_ / 2;
  b.p0 = reference + cold_offset_ + gamma * cold / V;
  b.p1 = gamma * lattice_ / V;
  b.p2 = c.electronic_gruneisen * heat_coefficient_ / (2 * V);
  if (phase == Phase::solid) return b;
  const double Tm = melting_temperature(V), m = lindemann_exponent(V) / V, tau = c.hot_liquid_ratio;
  const bool hot = phase == Phase::hot_liquid;
  const double heat = Tm * (melting_entropy_ - liquid_slope_ * (hot ? 1 - tau * tau : 1) / 2);
  b.e0 += heat;
  b.p0 -= m * heat;  // (G18)
  if (hot) {         // (G17)
    b.e1 -= tau * liquid_slope_;
    b.p1 += m * tau * liquid_slope_;
  } else {  // (G16)
    b.e2 -= liquid_slope_ / (2 * Tm);
    b.p2 += m * liquid_slope_ / (2 * Tm);
  }
  return b;
}

double Gray71::melting_pressure(double V, double E) const {  // (G14) with delta_T = 0
  const GrayBranch solid = branch(Phase::solid, V);
  const double Tm = melting_temperature(V);
  return solid.pressure(Tm) - lindemann_exponent(V) / V * (E - solid.energy(Tm));
}

void Gray71::complete(Point& p) const {
  const double h = difference * p.V;
  if (p.phase == Phase::melting) {
    const double Tm = melting_temperature(p.V), start = branch(Phase::solid, p.V).energy(Tm);
    p.T = Tm;
    p.melted_fraction = (p.E - start) / (Tm * (melting_entropy_ - liquid_slope_));
    p.P = melting_pressure(p.V, p.E);
    p.heat_capacity = INFINITY;
    p.gruneisen = -lindemann_exponent(p.V);
    p.isothermal_bulk_modulus = State::unknown;
    const double by_volume = (melting_pressure(p.V + h, p.E) - melting_pressure(p.V - h, p.E)) / (2 * h);
    p.squared_sound_speed = p.V * (p.P * p.gruneisen - p.V * by_volume);
    return;
  }
  const GrayBranch b = branch(p.phase, p.V);
  const GrayBranch wide = branch(p.phase, p.V + h), narrow = branch(p.phase, p.V - h);
  p.P = b.pressure(p.T);
  p.heat_capacity = b.heat_capacity(p.T);
  const double by_energy = b.pressure_by_temperature(p.T) / p.heat_capacity;
  const double by_volume = (wide.pressure(p.T) - narrow.pressure(p.T)) / (2 * h);  // at constant T
  const double energy_slope = (wide.energy(p.T) - narrow.energy(p.T)) / (2 * h);
  p.gruneisen = p.V * by_energy;
  p.isothermal_bulk_modulus = -p.V * by_volume;
  p.squared_sound_speed = p.V * p.V * (p.P * by_energy - (by_volume - by_energy * energy_slope));  // (G28)
  p.melted_fraction = p.phase == Phase::solid ? 0.0 : 1.0;
}

Gray71::Point Gray71::point(double V, double E) const {
  Point p;
  p.V = V;
  p.E = E;
  if (!(V > 0) || !std::isfinite(V)) {
    p.broken = "density must be positive and finite";
  } else if (!std::isfinite(E)) {
    p.broken = "specific internal energy must be finite";
  } else if (V < least_volume_) {
    p.broken = "density above the compression limit of the cold curve";
  }
  if (!p.broken.empty()) return p;
  if (V > join_volume_) {
    p.phase = Phase::vapour;
  } else {
    const double Tm = melting_temperature(V);
    if (E >= branch(Phase::liquid, V).energy(Tm)) {
      const bool hot = E > branch(Phase::hot_liquid, V).energy(constants_.hot_liquid_ratio * Tm);
      p.phase = hot ? Phase::hot_liquid : Phase::liquid;
    } else if (E > branch(Phase::solid, V).energy(Tm)) {
      p.phase = Phase::melting;
    }
  }
  if (p.phase != Phase::melting) {
    const GrayBranch b = branch(p.phase, V);
    p.cold = E < b.energy(least_temperature);
    p.T = p.cold ? least_temperature : b.temperature(E);
    if (!std::isfinite(p.T)) {
      p.broken = "energy above that at which the heat capacity vanishes";
      return p;
    }
  }
  complete(p);
  return p;
}

RangeReport Gray71::evaluate(const Batch& batch) const {
  RangeReport report;
  const double least = std::pow(least_sound_speed_ratio * constants_.hugoniot_intercept, 2);
  for (std::size_t i = 0; i < batch.density.size(); ++i) {
    const Point p = point(1.0 / batch.density[i], batch.specific_internal_energy[i]);
    const bool known = p.broken.empty();
    if (!known && report.out_of_range++ == 0) {
      report.first = i;
      report.bound = p.broken;
    }
    report.below_cold_curve += p.cold ? 1 : 0;
    batch.pressure[i] = known ? p.P : State::unknown;
    batch.temperature[i] = known ? p.T : State::unknown;
    batch.sound_speed[i] = known ? std::sqrt(std::max(p.squared_sound_speed, least)) : State::unknown;
    if (!batch.melted_fraction.empty()) batch.melted_fraction[i] = known ? p.melted_fraction : State::unknown;
    if (!batch.vaporised_fraction.empty()) {
      batch.vaporised_fraction[i] = known ? double(p.phase == Phase::vapour) : State::unknown;
    }
  }
  return report;
}

State Gray71::full_state(const Point& p) const {
  if (!p.broken.empty()) {
    throw StateError(
        fmt::format("gray_71: {} (density {:.6g} kg/m^3, compression limit {:.6g} kg/m^3, specific internal "
                    "energy {:.6g} J/kg, temperature {:.6g} K)",
                    p.broken, 1 / p.V, maximum_density(), p.E, p.T));
  }
  static constexpr std::array<std::string_view, 5> names = {"solid", "melting", "liquid", "hot liquid",
                                                            "vapour"};
  const double least = std::pow(least_sound_speed_ratio * constants_.hugoniot_intercept, 2);
  State s;  // without entropy, which these forms do not define
  s.density = 1 / p.V;
  s.specific_internal_energy = p.E;
  s.temperature = p.T;
  s.pressure = p.P;
  s.sound_speed = std::sqrt(std::max(p.squared_sound_speed, least));
  s.heat_capacity = p.heat_capacity;
  s.gruneisen = p.gruneisen;
  s.isothermal_bulk_modulus = p.isothermal_bulk_modulus;
  s.melted_fraction = p.melted_fraction;
  s.vaporised_fraction = p.phase == Phase::vapour ? 1.0 : 0.0;
  s.phase = names[static_cast<std::size_t>(p.phase)];
  return s;
}

State Gray71::state(double density, double specific_internal_energy) const {
  return full_state(point(1.0 / density, specific_internal_energy));
}

State Gray71::state_at_temperature(double density, double temperature) const {
  Point p;
  p.V = 1.0 / density;
  p.T = temperature;
  if (!(p.V > 0) || !std::isfinite(p.V) || p.V < least_volume_) {
    p.broken = "density must be positive and below the compression limit of the cold curve";
    return full_state(p);
  }
  if (!(temperature >= least_temperature) || !std::isfinite(temperature)) {
    p.broken = "temperature must be finite and not below 1 K";
    return full_state(p);
  }
  if (p.V > join_volume_) {
    p.phase = Phase::vapour;
  } else if (const double Tm = melting_temperature(p.V); temperature > Tm) {
    p.phase = temperature > constants_.hot_liquid_ratio * Tm ? Phase::hot_liquid : Phase::liquid;
  }
  p.E = branch(p.phase, p.V).energy(temperature);
  complete(p);
  return full_state(p);
}

}  // namespace whipple::eos

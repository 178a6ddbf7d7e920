// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md, "Two solid phases".
#include "eos/models/solid_transition.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double coldest_sought = 1.0, hottest_sought = 6000.0;  ///< K, of the equilibrium
constexpr int intervals = 256;

/// Declares the constants of one phase with a prefix, but for those that both have in common.
ParameterTable<SolidTransitionConstants> of_phase(
    const std::string& prefix, const std::string& phase,
    DebyeGruneisenConstants SolidTransitionConstants::* member) {
  ParameterTable<DebyeGruneisenConstants> table = DebyeGruneisen::phase_parameters();
  for (UnboundParameter& parameter : table) {
    parameter.info.name = prefix + parameter.info.name;
    parameter.info.meaning += ", " + phase;
  }
  return with_part(ParameterTable<SolidTransitionConstants>{}, member, table);
}

DebyeGruneisenConstants complete(DebyeGruneisenConstants phase, const SolidTransitionConstants& common) {
  phase.molar_mass = common.molar_mass;
  phase.reference_temperature = common.reference_temperature;
  return phase;
}

GrayPoint point_of(const State& s) {
  return {s.pressure,
          s.specific_internal_energy,
          s.specific_entropy,
          s.heat_capacity,
          s.gruneisen * s.heat_capacity * s.density,
          -s.isothermal_bulk_modulus * s.density};
}

/// Returns the volume of a phase at a pressure and a temperature.
double volume_at(const DebyeGruneisen& phase, double pressure, double temperature, const char* which) {
  return find_root(
      [&](double V) { return phase.state_at_temperature(1 / V, temperature).pressure - pressure; },
      1.000001 / phase.maximum_density(), 1 / phase.reference_density(), which);
}

}  // namespace

ParameterTable<SolidTransitionConstants> SolidTransitionConstants::parameters() {
  using C = SolidTransitionConstants;
  ParameterTable<C> table = {
      real("molar_mass", &C::molar_mass, "kg/mol", range::positive(), "mass of a mole of atoms"),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(),
           "T0, of both isotherms and of the transition pressure")
          .optional(),
      real("transition_pressure", &C::transition_pressure, "Pa", range::positive(),
           "of equal Gibbs energies of both phases at T0")};
  table.append(of_phase("low_", "phase at low pressure", &C::low));
  table.append(of_phase("high_", "phase at high pressure", &C::high));
  return table;
}

/// Holds where a state is.
struct SolidTransition::Place {
  Region region = Region::low;
  double temperature = State::unknown;
};

SolidTransition::SolidTransition(const Constants& constants)
    : constants_(constants),
      low_(complete(constants.low, constants)),
      high_(complete(constants.high, constants)) {
  if (!(high_.reference_density() > low_.reference_density())) {
    throw InputError(
        fmt::format("solid_transition: high_reference_density ({:.6g} kg/m^3) must exceed "
                    "low_reference_density ({:.6g} kg/m^3)",
                    high_.reference_density(), low_.reference_density()));
  }
  const double c = std::min(constants.low.bulk_modulus / low_.reference_density(),
                            constants.high.bulk_modulus / high_.reference_density());
  least_squared_sound_speed_ = c * std::pow(DebyeGruneisen::least_sound_speed_ratio, 2);
  tabulate();
}

GrayPoint SolidTransition::low_surface(double V, double T) const {
  return point_of(low_.state_at_temperature(1 / V, T));
}

GrayPoint SolidTransition::high_surface(double V, double T) const {
  GrayPoint p = point_of(high_.state_at_temperature(1 / V, T));
  p.energy += energy_offset_;
  return p;
}

void SolidTransition::tabulate() {
  const double P = constants_.transition_pressure, T0 = constants_.reference_temperature;
  const double low = volume_at(low_, P, T0, "volume of the low-pressure phase at the transition");
  const double high = volume_at(high_, P, T0, "volume of the high-pressure phase at the transition");
  energy_offset_ = low_surface(low, T0).gibbs(low, T0) - high_surface(high, T0).gibbs(high, T0);
  const VolumeRange range{1.000001 / high_.maximum_density(), 0.999999 / low_.minimum_density()};
  const PhaseSurfaceFunction dense = [this](double V, double T) { return high_surface(V, T); };
  const PhaseSurfaceFunction thin = [this](double V, double T) { return low_surface(V, T); };
  const auto follow = [&](const CommonTangent& from, double T) {
    return common_tangent(dense, thin, T, from.dense + from.dense1 * (T - from.T),
                          from.thin + from.thin1 * (T - from.T), range);
  };
  const std::optional<CommonTangent> start = common_tangent(dense, thin, T0, high, low, range);
  if (!start) {
    throw InputError(
        fmt::format("solid_transition: at transition_pressure = {:.6g} Pa the phases have volumes of {:.6g} "
                    "(low) and {:.6g} "
                    "m^3/kg (high): the phase at high pressure must be the denser one",
                    P, low, high));
  }
  const auto march = [&](double end) {
    CommonTangent at = *start;
    double step = (end - T0) / 100;
    while (std::abs(step) > 1e-3 && std::abs(end - at.T) > 1e-9 * end) {
      const double T = std::abs(end - at.T) < std::abs(step) ? end : at.T + step;
      const std::optional<CommonTangent> next = follow(at, T);
      if (next && next->P > 0) {
        at = *next;
      } else {
        step /= 2;
      }
    }
    return at;
  };
  const CommonTangent first = march(coldest_sought);
  coldest_ = first.T;
  hottest_ = march(hottest_sought).T;
  const double step = (hottest_ - coldest_) / intervals;
  std::vector<HermiteTable::Node> pressure, gibbs, low_volume, high_volume;
  CommonTangent at = first;
  for (int i = 0; i <= intervals; ++i) {
    if (i > 0) {
      const std::optional<CommonTangent> next = follow(at, coldest_ + i * step);
      if (!next) {
        throw InputError(
            fmt::format("solid_transition: the equilibrium is lost at {:.6g} K", coldest_ + i * step));
      }
      at = *next;
    }
    pressure.push_back({at.P, at.P1, at.P2});
    gibbs.push_back({at.g, at.g1, at.g2});
    low_volume.push_back({at.thin, at.thin1, 0});
    high_volume.push_back({at.dense, at.dense1, 0});
  }
  add_curvatures(low_volume, step);
  add_curvatures(high_volume, step);
  pressure_ = HermiteTable(coldest_, step, std::move(pressure));
  gibbs_ = HermiteTable(coldest_, step, std::move(gibbs));
  low_volume_ = HermiteTable(coldest_, step, std::move(low_volume));
  high_volume_ = HermiteTable(coldest_, step, std::move(high_volume));
}

double SolidTransition::within(double T) const { return std::clamp(T, coldest_, hottest_); }

PhaseMixture SolidTransition::mixture(double V, double T) const {
  return phase_mixture(pressure_.at(T), gibbs_.at(T), V, T);
}

SolidTransition::Place SolidTransition::place(double V, double E, double low_temperature,
                                              double high_temperature) const {
  if (V >= low_volume(low_temperature)) return {Region::low, low_temperature};
  if (V <= high_volume(high_temperature)) return {Region::high, high_temperature};
  if (std::isnan(low_temperature) && std::isnan(high_temperature)) return {};
  // The energy of the mixture rises with T: Newton's method within a shrinking bracket.
  double low = coldest_, high = hottest_;
  double T = within(std::isnan(low_temperature) ? high_temperature : low_temperature);
  for (int i = 0; i < 100; ++i) {
    const PhaseMixture m = mixture(V, T);
    (m.energy > E ? high : low) = T;
    double next = T - (m.energy - E) / m.heat_capacity;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double change = std::abs(next - T);
    T = next;
    if (change <= 4 * std::numeric_limits<double>::epsilon() * T) break;
  }
  return {Region::mixture, T};
}

RangeReport SolidTransition::evaluate(const Batch& batch) const {
  constexpr std::size_t chunk = 64;
  RangeReport report;
  const std::size_t size = batch.density.size();
  std::array<double, chunk> energy, low_P, low_T, low_c, high_P, high_T, high_c;
  for (std::size_t first = 0; first < size; first += chunk) {
    const std::size_t count = std::min(chunk, size - first);
    const auto part = [count](std::array<double, chunk>& values) { return std::span(values).first(count); };
    const auto density = batch.density.subspan(first, count);
    const auto given = batch.specific_internal_energy.subspan(first, count);
    for (std::size_t i = 0; i < count; ++i) energy[i] = given[i] - energy_offset_;
    low_.evaluate({density, given, part(low_P), part(low_T), part(low_c), {}, {}, {}});
    const RangeReport dense =
        high_.evaluate({density, part(energy), part(high_P), part(high_T), part(high_c), {}, {}, {}});
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = first + i;
      const double V = 1 / density[i];
      const Place found = place(V, given[i], low_T[i], high_T[i]);
      double P = State::unknown, c = State::unknown;
      switch (found.region) {
        case Region::low:
          P = low_P[i];
          c = low_c[i];
          break;
        case Region::high:
          P = high_P[i];
          c = high_c[i];
          break;
        case Region::mixture: {
          const PhaseMixture m = mixture(V, found.temperature);
          P = m.pressure;
          const double squared = V * V * found.temperature * m.pressure_by_temperature *
                                 m.pressure_by_temperature / m.heat_capacity;  // (G35)
          c = std::sqrt(std::max(squared, least_squared_sound_speed_));
          break;
        }
      }
      batch.pressure[at] = P;
      batch.temperature[at] = found.temperature;
      batch.sound_speed[at] = c;
      if (!batch.melted_fraction.empty()) batch.melted_fraction[at] = 0;
      if (!batch.vaporised_fraction.empty()) batch.vaporised_fraction[at] = 0;
      if (!std::isfinite(P)) {
        if (report.out_of_range++ == 0) {
          report.first = at;
          report.bound =
              dense.bound.empty() ? "density must be within the ranges of the phases" : dense.bound;
        }
      } else if (found.temperature <= least_temperature) {
        ++report.below_cold_curve;
      }
    }
  }
  return report;
}

State SolidTransition::mixed_state(double V, double T) const {
  const PhaseMixture m = mixture(V, T);
  State s;
  s.density = 1 / V;
  s.temperature = T;
  s.pressure = m.pressure;
  s.specific_internal_energy = m.energy;
  s.specific_entropy = m.entropy;
  s.heat_capacity = m.heat_capacity;
  s.gruneisen = V * m.pressure_by_temperature / m.heat_capacity;
  s.isothermal_bulk_modulus = 0;
  s.sound_speed =
      std::sqrt(std::max(V * V * T * m.pressure_by_temperature * m.pressure_by_temperature / m.heat_capacity,
                         least_squared_sound_speed_));
  s.phase = "two solids";
  s.melted_fraction = s.vaporised_fraction = 0;
  return s;
}

State SolidTransition::state(double density, double energy) const {
  std::array<double, 1> rho{density}, e{energy}, P{}, T{}, c{};
  const RangeReport report = evaluate({rho, e, P, T, c, {}, {}, {}});
  if (report.out_of_range > 0) {
    throw StateError(
        fmt::format("solid_transition: {} (density {:.6g} kg/m^3, specific internal energy {:.6g} J/kg)",
                    report.bound, density, energy));
  }
  return state_at_temperature(density, T[0]);
}

State SolidTransition::state_at_temperature(double density, double temperature) const {
  const double V = 1 / density;
  State s;
  if (V >= low_volume(temperature)) {
    s = low_.state_at_temperature(density, temperature);
    s.phase = "low-pressure solid";
  } else if (V <= high_volume(temperature)) {
    s = high_.state_at_temperature(density, temperature);
    s.specific_internal_energy += energy_offset_;
    s.phase = "high-pressure solid";
  } else {
    s = mixed_state(V, within(temperature));
  }
  s.melted_fraction = s.vaporised_fraction = 0;
  return s;
}

}  // namespace whipple::eos

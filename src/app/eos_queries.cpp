// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eos/inversions.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/units.hpp"

namespace whipple::app {
namespace {

using eos::EquationOfState;
using eos::Hugoniot;
using eos::State;

const Column up_column = {"up_km_s", "km/s", 1e3, "particle velocity"};
const Column us_column = {"us_km_s", "km/s", 1e3, "shock velocity"};
const Column riemann_column = {"u_km_s", "km/s", 1e3, "Riemann velocity"};
const Column pressure_column = {"P_GPa", "GPa", 1e9, "pressure"};

bool is_in(const std::string& text, const char* unit) {
  try {
    static_cast<void>(units::parse_quantity(text, unit));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// The end of a curve: a pressure, or the other quantity that the curve may run over.
struct End {
  double value;
  bool is_pressure;
};

End end_of(const EosOptions& o, double standard_pressure, const char* other_unit) {
  if (o.to.empty()) return {standard_pressure, true};
  if (is_in(o.to, "Pa")) return {*quantity("--to", o.to, "Pa"), true};
  if (is_in(o.to, other_unit)) return {*quantity("--to", o.to, other_unit), false};
  throw InputError(fmt::format("--to: '{}': expected a quantity in Pa or in {}", o.to, other_unit));
}

CurveTable table_of(const std::string& title, const Materials& materials, std::vector<Column> leading,
                    std::vector<Column> following) {
  CurveTable table;
  table.title = title;
  if (materials.size() == 1) {
    table.title += fmt::format(": {} ({})", materials[0].name, materials[0].eos->model());
  }
  table.columns = std::move(leading);
  table.columns.insert(table.columns.end(), following.begin(), following.end());
  for (const Material& material : materials) table.series.push_back({material.name, {}});
  return table;
}

CurveRow row_of(const EquationOfState& eos, const State& state, CurveRow leading = {}) {
  for (const Cell& cell : state_cells(state, eos)) leading.push_back(cell);
  return leading;
}

/// Rows of a curve over values. A model that ends on the way ends the curve, with a message; one that has no
/// row at all is an error.
template <class Row>
void fill(Series& series, const std::vector<double>& values, const Row& row) {
  for (const double value : values) {
    try {
      series.rows.push_back(row(value));
    } catch (const StateError& error) {
      if (series.rows.empty()) throw;
      log::warning("{}: the curve ends after {} points: {}", series.name, series.rows.size(), error.what());
      return;
    }
  }
}

/// The state that two of density, temperature, energy, pressure and entropy name; without any, the reference
/// state.
State state_from(const EosOptions& o, const EquationOfState& eos) {
  const auto density = quantity("--density", o.density, "kg/m^3"),
             temperature = quantity("--temperature", o.temperature, "K");
  const auto energy = quantity("--energy", o.energy, "J/kg"),
             pressure = quantity("--pressure", o.pressure, "Pa");
  const auto entropy = quantity("--entropy", o.entropy, "J/(kg K)");
  const int given = density.has_value() + temperature.has_value() + energy.has_value() +
                    pressure.has_value() + entropy.has_value();
  if (given == 0) return eos.state(eos.reference_density(), eos.reference_energy());
  if (given == 2 && density && temperature) return eos.state_at_temperature(*density, *temperature);
  if (given == 2 && density && energy) {
    const State state = eos.state(*density, *energy);  // of the coldest state, if there is less energy
    if (const double least = eos.minimum_energy(*density); *energy < least) {
      throw StateError(fmt::format(
          "{}: no state with {:.6g} J/kg at {:.6g} kg/m^3: the coldest one, of {} K, has {:.6g} J/kg",
          eos.model(), *energy, *density, eos.least_temperature(), least));
    }
    return state;
  }
  if (given == 2 && density && pressure) return eos::state_at_pressure(eos, *density, *pressure);
  if (given == 2 && density && entropy) return eos::state_at_entropy(eos, *density, *entropy);
  if (given == 2 && pressure && temperature) {
    return eos::state_at_pressure_and_temperature(eos, *pressure, *temperature);
  }
  throw InputError(
      "a state is named by two quantities: --density with --temperature, --energy, --pressure or --entropy, "
      "or "
      "--pressure with --temperature");
}

/// The Hugoniot that the options ask for: principal, porous, or through a shocked state.
Hugoniot hugoniot_from(const EosOptions& o, const EquationOfState& eos) {
  const auto initial = quantity("--initial-density", o.initial_density, "kg/m^3");
  const auto first = quantity("--reflected", o.reflected, "Pa");
  const Hugoniot hugoniot =
      initial && *initial < eos.reference_density() ? Hugoniot::porous(eos, *initial) : Hugoniot(eos);
  if (initial && *initial > eos.reference_density()) {
    throw InputError(
        fmt::format("--initial-density: {:.6g} kg/m^3 is above the reference density of {:.6g} "
                    "kg/m^3",
                    *initial, eos.reference_density()));
  }
  if (!first) return hugoniot;
  const State shocked = hugoniot.at_pressure(*first).state;
  return {eos, shocked.density, shocked.specific_internal_energy};
}

std::optional<eos::ShockState> shock_from(const EosOptions& o, const Hugoniot& hugoniot) {
  const auto density = quantity("--density", o.density, "kg/m^3"),
             pressure = quantity("--pressure", o.pressure, "Pa");
  const auto velocity = quantity("--particle-velocity", o.particle_velocity, "m/s");
  const int given = density.has_value() + pressure.has_value() + velocity.has_value();
  if (given == 0) return std::nullopt;
  if (given > 1) throw InputError("a shock is named by one of --pressure, --particle-velocity and --density");
  if (density) return hugoniot.at_density(*density);
  return pressure ? hugoniot.at_pressure(*pressure) : hugoniot.at_particle_velocity(*velocity);
}

eos::ShockState required_shock(const EosOptions& o, const EquationOfState& eos) {
  if (const auto shock = shock_from(o, hugoniot_from(o, eos))) return *shock;
  throw InputError("a shock is named by one of --pressure, --particle-velocity and --density");
}

CurveRow shock_row(const EquationOfState& eos, const eos::ShockState& s) {
  return row_of(eos, s.state, {s.particle_velocity, s.shock_velocity});
}

/// Equal distances of ln(rho) from the start.
void add_isentrope(Series& series, const EquationOfState& eos, const State& start, double last_density,
                   int points) {
  std::vector<double> densities;
  for (const double x : spaced(std::log(start.density), std::log(last_density), points)) {
    densities.push_back(std::exp(x));
  }
  for (const eos::IsentropeState& s : eos::isentrope(eos, start, densities)) {
    series.rows.push_back(row_of(eos, s.state, {s.riemann_velocity}));
  }
}

}  // namespace

std::optional<double> quantity(const char* option, const std::string& text, const char* unit) {
  if (text.empty()) return std::nullopt;
  double value = 0;
  try {
    value = units::parse_quantity(text, unit);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
  const std::string_view kind = unit;
  const Range range = kind == "kg/m^3" || kind == "K" ? range::positive()
                      : kind == "m/s"                 ? range::non_negative()
                                                      : range::any();
  if (!range.contains(value))
    throw InputError(fmt::format("{}: is {}, but must be {} {}", option, text, range.text(), unit));
  return value;
}

std::vector<double> spaced(double from, double to, int points) {
  std::vector<double> values;
  for (int i = 0; i < points; ++i) values.push_back(points > 1 ? from + (to - from) * i / (points - 1) : to);
  return values;
}

CurveTable state_table(const EosOptions& o, const Materials& materials) {
  CurveTable table = table_of("State", materials, {}, state_columns());
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const EquationOfState& eos = *materials[i].eos;
    table.series[i].rows.push_back(row_of(eos, state_from(o, eos)));
  }
  return table;
}

std::vector<std::string> state_remarks(const EosOptions& o, const Materials& materials) {
  std::vector<std::string> remarks;
  for (const Material& material : materials) {
    const State s = state_from(o, *material.eos);
    if (s.phase.find("vapour") == std::string_view::npos || !(s.vaporised_fraction < 0.5)) continue;
    remarks.push_back(fmt::format(
        "{}: \"{}\" names the surface of the model, which goes on beyond the limit of stretched matter. Matter "
        "of this density and energy in equilibrium is condensed, with voids: {:.2g} % of its mass is vapour",
        material.name, s.phase, 100 * s.vaporised_fraction));
  }
  return remarks;
}

CurveTable hugoniot_table(const EosOptions& o, const Materials& materials) {
  const std::string title = !o.reflected.empty()
                                ? fmt::format("Hugoniot from the state shocked to {}", o.reflected)
                            : !o.initial_density.empty() ? fmt::format("Hugoniot from {}", o.initial_density)
                                                         : std::string("Principal Hugoniot");
  CurveTable table = table_of(title, materials, {up_column, us_column}, state_columns());
  const End end = end_of(o, 200 * GPa, "m/s");
  const double first = quantity("--from", o.from, end.is_pressure ? "Pa" : "m/s").value_or(0.0);
  if (first < 0 || end.value < 0) throw InputError("--from, --to: a shock compresses: expected >= 0");
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const EquationOfState& eos = *materials[i].eos;
    const Hugoniot hugoniot = hugoniot_from(o, eos);
    if (const auto shock = shock_from(o, hugoniot)) {
      table.series[i].rows.push_back(shock_row(eos, *shock));
      continue;
    }
    const double begin = end.is_pressure ? std::max(first, hugoniot.initial().pressure) : first;
    if (begin > end.value) {
      throw InputError(
          fmt::format("the curve begins at {:.4g} {}, beyond --to", begin, end.is_pressure ? "Pa" : "m/s"));
    }
    fill(table.series[i], spaced(begin, end.value, o.points), [&](double value) {
      return shock_row(eos,
                       end.is_pressure ? hugoniot.at_pressure(value) : hugoniot.at_particle_velocity(value));
    });
  }
  return table;
}

CurveTable isotherm_table(const EosOptions& o, const Materials& materials) {
  const auto asked = quantity("--temperature", o.temperature, "K");
  CurveTable table =
      table_of(asked ? fmt::format("Isotherm at {} K", *asked) : "Isotherm at the reference temperature",
               materials, {}, state_columns());
  const double first = quantity("--from", o.from, "Pa").value_or(0.0),
               last = quantity("--to", o.to, "Pa").value_or(100 * GPa);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const EquationOfState& eos = *materials[i].eos;
    const double T = asked.value_or(eos.reference_temperature());
    std::optional<double> density;
    fill(table.series[i], spaced(first, last, o.points), [&](double pressure) {
      const State s = eos::state_at_pressure_and_temperature(eos, pressure, T, density);
      density = s.density;
      return row_of(eos, s);
    });
  }
  return table;
}

CurveTable isentrope_table(const EosOptions& o, const Materials& materials) {
  CurveTable table = table_of("Isentrope", materials, {riemann_column}, state_columns());
  const End end = end_of(o, 100 * GPa, "kg/m^3");
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const EquationOfState& eos = *materials[i].eos;
    const State start = state_from(o, eos);
    const double last =
        end.is_pressure ? eos::isentrope_at_pressure(eos, start, end.value).state.density : end.value;
    add_isentrope(table.series[i], eos, start, last, o.points);
  }
  return table;
}

CurveTable release_table(const EosOptions& o, const Materials& materials) {
  CurveTable table = table_of("Release of a shocked state", materials, {riemann_column}, state_columns());
  const double pressure = quantity("--to", o.to, "Pa").value_or(0.0);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const EquationOfState& eos = *materials[i].eos;
    const State shocked = required_shock(o, eos).state;
    const eos::Release release = eos::release(eos, shocked, pressure);
    if (release.in_equilibrium) {
      table.series[i].rows.push_back(row_of(eos, shocked, {0.0}));
      table.series[i].rows.push_back(row_of(eos, release.end.state, {release.end.riemann_velocity}));
    } else {
      add_isentrope(table.series[i], eos, shocked, release.end.state.density, o.points);
    }
  }
  return table;
}

std::vector<std::string> release_remarks(const EosOptions& o, const Materials& materials) {
  const double pressure = quantity("--to", o.to, "Pa").value_or(0.0);
  std::vector<std::string> remarks;
  for (const Material& material : materials) {
    const eos::ShockState shock = required_shock(o, *material.eos);
    std::string text = fmt::format("{}: shock up {:.4g} km/s, Us {:.4g} km/s", material.name,
                                   shock.particle_velocity * 1e-3, shock.shock_velocity * 1e-3);
    const eos::Release release = eos::release(*material.eos, shock.state, pressure);
    if (!release.in_equilibrium) {
      text += fmt::format("; velocity of the released surface {:.5g} km/s",
                          (shock.particle_velocity - release.end.riemann_velocity) * 1e-3);
    }
    remarks.push_back(text);
  }
  return remarks;
}

std::vector<std::string> hugoniot_remarks(const EosOptions& o, const Materials& materials) {
  std::vector<std::string> remarks;
  for (const Material& material : materials) {
    const EquationOfState& eos = *material.eos;
    if (const auto first = quantity("--reflected", o.reflected, "Pa")) {
      EosOptions unreflected = o;
      unreflected.reflected.clear();
      const eos::ShockState shocked = hugoniot_from(unreflected, eos).at_pressure(*first);
      const eos::ShockState second = eos::reflected_at_wall(eos, shocked);
      remarks.push_back(
          fmt::format("{}: off a rigid wall {:.2f} GPa, {:.0f} K, {:.1f} kg/m^3; back against the "
                      "shocked matter at {:.4g} km/s",
                      material.name, second.state.pressure / GPa, second.state.temperature,
                      second.state.density, second.shock_velocity * 1e-3));
    } else if (o.initial_density.empty()) {
      if (const auto melting = eos::shock_melting(eos)) {
        remarks.push_back(
            fmt::format("{}: shock melting: onset {:.2f} GPa, {:.0f} K; completion {:.2f} GPa, {:.0f} K",
                        material.name, melting->onset.state.pressure / GPa, melting->onset.state.temperature,
                        melting->completion.state.pressure / GPa, melting->completion.state.temperature));
      }
    }
  }
  return remarks;
}

CurveTable cold_table(const EosOptions& o, const Materials& materials) {
  CurveTable table = table_of("Cold curve", materials, {}, state_columns());
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const EquationOfState& eos = *materials[i].eos;
    const double rho0 = eos.reference_density();
    const double first = quantity("--from", o.from, "kg/m^3").value_or(0.9 * rho0);
    const double last =
        quantity("--to", o.to, "kg/m^3").value_or(std::min(1.5 * rho0, eos.maximum_density()));
    fill(table.series[i], spaced(first, last, o.points),
         [&](double density) { return row_of(eos, eos::cold_state(eos, density)); });
  }
  return table;
}

std::vector<std::string> cold_remarks(const EosOptions& /*options*/, const Materials& materials) {
  std::vector<std::string> remarks;
  for (const Material& material : materials) {
    const eos::ColdCurve cold = eos::cold_curve(*material.eos);
    std::string text = fmt::format("{}: at rest {:.5g} kg/m^3", material.name, cold.at_rest.density);
    if (!cold.tension_limit.phase.empty()) {
      text += fmt::format("; limit in tension {:.4g} GPa at {:.5g} kg/m^3", cold.tension_limit.pressure / GPa,
                          cold.tension_limit.density);
    }
    text += fmt::format("; compression limit {:.5g} kg/m^3, {:.4g} GPa", cold.compression_limit.density,
                        cold.compression_limit.pressure / GPa);
    if (std::isfinite(cold.cohesive_energy)) {
      text += fmt::format("; cohesive energy {:.4g} MJ/kg", cold.cohesive_energy * 1e-6);
    }
    remarks.push_back(text);
  }
  return remarks;
}

CurveTable melt_table(const EosOptions& o, const Materials& materials) {
  CurveTable table = table_of("Melting line", materials, {},
                              {pressure_column,
                               {"solidus_K", "K", 1, "temperature of the solidus"},
                               {"liquidus_K", "K", 1, "temperature of the liquidus"},
                               {"solid_kg_m3", "kg/m^3", 1, "density of the solid"},
                               {"liquid_kg_m3", "kg/m^3", 1, "density of the liquid"}});
  const double first = quantity("--from", o.from, "Pa").value_or(0.0),
               last = quantity("--to", o.to, "Pa").value_or(100 * GPa);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const EquationOfState& eos = *materials[i].eos;
    fill(table.series[i], spaced(first, last, o.points), [&](double pressure) {
      const auto melting = eos::melting_point(eos, pressure);
      if (!melting)
        throw StateError(fmt::format("model {} of {} does not melt", eos.model(), materials[i].name));
      return CurveRow{pressure, melting->solidus.temperature, melting->liquidus.temperature,
                      melting->solidus.density, melting->liquidus.density};
    });
  }
  return table;
}

std::vector<std::string> melt_remarks(const EosOptions& /*options*/, const Materials& materials) {
  std::vector<std::string> remarks;
  const auto threshold = [](const char* what, const std::optional<eos::ShockState>& shock) {
    return shock ? fmt::format("{} {:.1f} GPa ({:.3g} km/s)", what, shock->state.pressure / GPa,
                               shock->particle_velocity * 1e-3)
                 : std::string();
  };
  for (const Material& material : materials) {
    const eos::ReleaseThresholds release = eos::release_thresholds(*material.eos, 1e5);
    std::string text;
    for (const std::string& part : {threshold("melting begins", release.incipient_melting),
                                    threshold("is complete", release.complete_melting),
                                    threshold("vaporisation begins", release.incipient_vaporisation),
                                    threshold("is complete", release.complete_vaporisation)}) {
      if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
    }
    if (!text.empty()) remarks.push_back(fmt::format("{}: after release to 1 bar: {}", material.name, text));
  }
  return remarks;
}

CurveTable dome_table(const EosOptions& o, const Materials& materials) {
  CurveTable table = table_of("Liquid and vapour in equilibrium", materials, {},
                              {{"P_MPa", "MPa", 1e6, "pressure"},
                               {"T_K", "K", 1, "temperature"},
                               {"liquid_kg_m3", "kg/m^3", 1, "density of the liquid"},
                               {"vapour_kg_m3", "kg/m^3", 1, "density of the vapour"},
                               {"latent_kJ_kg", "kJ/kg", 1e3, "enthalpy of vaporisation"}});
  const double lower = quantity("--from", o.from, "Pa").value_or(100.0);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const EquationOfState& eos = *materials[i].eos;
    const eos::VapourDome* dome = eos.vapour_dome();
    if (dome == nullptr || !dome->at_pressure(lower)) {
      throw InputError(fmt::format("model {} of {} has no liquid and vapour in equilibrium at {:.4g} Pa",
                                   eos.model(), materials[i].name, lower));
    }
    const double top = 0.999 * dome->critical_point().pressure;
    const double last = std::min(top, quantity("--to", o.to, "Pa").value_or(top));
    for (const double x : spaced(std::log(lower), std::log(last), o.points)) {
      const auto s = dome->at_pressure(std::min(std::exp(x), last));
      table.series[i].rows.push_back(
          {s->pressure, s->temperature, 1 / s->liquid_volume, 1 / s->vapour_volume, s->latent_heat()});
    }
  }
  return table;
}

std::vector<std::string> dome_remarks(const EosOptions& /*options*/, const Materials& materials) {
  std::vector<std::string> remarks;
  for (const Material& material : materials) {
    const eos::CriticalPoint& critical = material.eos->vapour_dome()->critical_point();
    remarks.push_back(fmt::format("{}: critical point {:.5g} K, {:.4g} GPa, {:.4g} g/cm^3", material.name,
                                  critical.temperature, critical.pressure / GPa,
                                  1e-3 / critical.specific_volume));
  }
  return remarks;
}

namespace {

/// The interfaces that a shock passes, from the impact on.
std::vector<eos::ImpedanceMatch> interfaces(const EosOptions& o, const Materials& materials) {
  if (materials.size() < 2)
    throw InputError("an impact has two materials at least: IMPACTOR TARGET [BEHIND ...]");
  const auto velocity = quantity("--velocity", o.velocity, "m/s");
  if (!velocity || *velocity == 0)
    throw InputError("an impact needs a --velocity above zero, e.g. --velocity '5 km/s'");
  std::vector<eos::ImpedanceMatch> matches = {
      eos::match_impact(Hugoniot(*materials[0].eos), Hugoniot(*materials[1].eos), *velocity)};
  for (std::size_t i = 2; i < materials.size(); ++i) {
    const eos::ImpedanceMatch& last = matches.back();
    matches.push_back(eos::match_shock(*materials[i - 1].eos,
                                       {last.right, last.right_shock_velocity, last.velocity},
                                       Hugoniot(*materials[i].eos)));
  }
  return matches;
}

}  // namespace

CurveTable match_table(const EosOptions& o, const Materials& materials) {
  const std::vector<eos::ImpedanceMatch> matches = interfaces(o, materials);
  CurveTable table;
  table.title = fmt::format("Impact of {} on {} with {}", materials[0].name, materials[1].name, o.velocity);
  table.columns = {
      {"interface", "", 1, "interface"}, {"u_km_s", "km/s", 1e3, "velocity of the interface"}, us_column};
  for (const Column& column : state_columns()) table.columns.push_back(column);
  table.series.push_back({"", {}});
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const eos::ImpedanceMatch& m = matches[i];
    const std::string arrow = std::isnan(m.left_shock_velocity) ? " (released)" : " (shocked)";
    table.series[0].rows.push_back(
        row_of(*materials[i].eos, m.left, {materials[i].name + arrow, m.velocity, m.left_shock_velocity}));
    table.series[0].rows.push_back(
        row_of(*materials[i + 1].eos, m.right,
               {materials[i + 1].name + " (shocked)", m.velocity, m.right_shock_velocity}));
  }
  return table;
}

std::vector<std::string> match_remarks(const EosOptions& o, const Materials& materials) {
  const eos::ImpedanceMatch last = interfaces(o, materials).back();
  const EquationOfState& eos = *materials.back().eos;
  try {
    return {fmt::format(
        "free surface of {}: {:.5g} km/s", materials.back().name,
        1e-3 * eos::free_surface_velocity(eos, {last.right, last.right_shock_velocity, last.velocity}))};
  } catch (const StateError& error) {
    return {fmt::format("free surface of {}: {}", materials.back().name, error.what())};
  }
}

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "src/app/eos_audit.hpp"
#include "src/app/eos_table.hpp"
#include "src/base/error.hpp"
#include "src/base/units.hpp"
#include "src/material/material_file.hpp"

namespace whipple::app {
namespace {

using eos::EquationOfState;
using eos::Hugoniot;
using eos::State;

/// What the subcommands of `whipple eos` have in common; quantities as the user wrote them.
struct Options {
  std::string material;
  std::string density, temperature, energy, pressure, particle_velocity;
  std::string from, to;
  int points = 21;
  CurveOutput output;
};

/// The quantity of an option, if it is given; errors name the option.
std::optional<double> quantity(const char* option, const std::string& text, const char* unit) {
  if (text.empty()) return std::nullopt;
  try {
    return units::parse_quantity(text, unit);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

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

End end_of(const Options& o, double standard_pressure, const char* other_unit) {
  if (o.to.empty()) return {standard_pressure, true};
  if (is_in(o.to, "Pa")) return {units::parse_quantity(o.to, "Pa"), true};
  if (is_in(o.to, other_unit)) return {units::parse_quantity(o.to, other_unit), false};
  throw InputError(fmt::format("--to: '{}': expected a quantity in Pa or in {}", o.to, other_unit));
}

std::vector<double> spaced(double from, double to, int points) {
  std::vector<double> values;
  for (int i = 0; i < points; ++i) values.push_back(points > 1 ? from + (to - from) * i / (points - 1) : to);
  return values;
}

CurveTable table_of(const std::string& title, const Material& material, std::vector<Column> leading = {}) {
  CurveTable table;
  table.title = fmt::format("{}: {} ({})", title, material.name, material.eos->model());
  table.columns = std::move(leading);
  for (const Column& column : state_columns()) table.columns.push_back(column);
  return table;
}

void add_row(CurveTable& table, const EquationOfState& eos, const State& state,
             std::vector<Cell> leading = {}) {
  for (const Cell& cell : state_cells(state, eos)) leading.push_back(cell);
  table.rows.push_back(std::move(leading));
}

const std::vector<Column> shock_columns = {{"up_km_s", "km/s", 1e3}, {"us_km_s", "km/s", 1e3}};

/// The state that two of density, temperature, energy and pressure name; without any, the reference state.
State state_from(const Options& o, const EquationOfState& eos) {
  const auto density = quantity("--density", o.density, "kg/m^3"),
             temperature = quantity("--temperature", o.temperature, "K");
  const auto energy = quantity("--energy", o.energy, "J/kg"),
             pressure = quantity("--pressure", o.pressure, "Pa");
  const int given = density.has_value() + temperature.has_value() + energy.has_value() + pressure.has_value();
  if (given == 0) return eos.state(eos.reference_density(), eos.reference_energy());
  if (given == 2 && density && temperature) return eos.state_at_temperature(*density, *temperature);
  if (given == 2 && density && energy) return eos.state(*density, *energy);
  if (given == 2 && density && pressure) return eos::state_at_pressure(eos, *density, *pressure);
  if (given == 2 && pressure && temperature) {
    return eos.state_at_temperature(eos::density_at_pressure(eos, *pressure, *temperature), *temperature);
  }
  throw InputError(
      "a state is named by two quantities: --density with --temperature, --energy or --pressure, or "
      "--pressure with "
      "--temperature");
}

eos::ShockState shock_from(const Options& o, const Hugoniot& hugoniot) {
  const auto density = quantity("--density", o.density, "kg/m^3"),
             pressure = quantity("--pressure", o.pressure, "Pa");
  const auto velocity = quantity("--particle-velocity", o.particle_velocity, "m/s");
  if (density.has_value() + pressure.has_value() + velocity.has_value() != 1) {
    throw InputError("a shock is named by one of --pressure, --particle-velocity and --density");
  }
  if (density) return hugoniot.at_density(*density);
  return pressure ? hugoniot.at_pressure(*pressure) : hugoniot.at_particle_velocity(*velocity);
}

void run_state(const Options& o, const Material& material) {
  CurveTable table = table_of("State", material);
  add_row(table, *material.eos, state_from(o, *material.eos));
  write(table, o.output);
}

void run_hugoniot(const Options& o, const Material& material) {
  const EquationOfState& eos = *material.eos;
  const Hugoniot hugoniot(eos);
  CurveTable table = table_of("Principal Hugoniot", material, shock_columns);
  const auto add = [&](const eos::ShockState& s) {
    add_row(table, eos, s.state, {s.particle_velocity, s.shock_velocity});
  };
  if (!o.pressure.empty() || !o.particle_velocity.empty() || !o.density.empty()) {
    add(shock_from(o, hugoniot));
  } else {
    const End end = end_of(o, 200e9, "m/s");
    const double first = quantity("--from", o.from, end.is_pressure ? "Pa" : "m/s").value_or(0.0);
    if (first < 0 || end.value < 0) throw InputError("--from, --to: a shock compresses: expected >= 0");
    for (const double value : spaced(first, end.value, o.points)) {
      add(end.is_pressure ? hugoniot.at_pressure(std::max(value, hugoniot.initial().pressure))
                          : hugoniot.at_particle_velocity(value));
    }
  }
  write(table, o.output);
  if (const auto melting = eos::shock_melting(eos)) {
    fmt::print("shock melting: onset {:.2f} GPa, {:.0f} K; completion {:.2f} GPa, {:.0f} K\n",
               melting->onset.state.pressure * 1e-9, melting->onset.state.temperature,
               melting->completion.state.pressure * 1e-9, melting->completion.state.temperature);
  }
}

void run_isotherm(const Options& o, const Material& material) {
  const EquationOfState& eos = *material.eos;
  const double T = quantity("--temperature", o.temperature, "K").value_or(eos.reference_temperature());
  CurveTable table = table_of(fmt::format("Isotherm at {} K", T), material);
  const double first = quantity("--from", o.from, "Pa").value_or(0.0),
               last = quantity("--to", o.to, "Pa").value_or(100e9);
  for (const double pressure : spaced(first, last, o.points)) {
    add_row(table, eos, eos.state_at_temperature(eos::density_at_pressure(eos, pressure, T), T));
  }
  write(table, o.output);
}

const Column riemann_column = {"u_km_s", "km/s", 1e3};

void add_isentrope(CurveTable& table, const EquationOfState& eos, const State& start, double last_density,
                   int points) {
  std::vector<double> densities;
  for (const double x : spaced(std::log(start.density), std::log(last_density), points))
    densities.push_back(std::exp(x));
  for (const eos::IsentropeState& s : eos::isentrope(eos, start, densities)) {
    add_row(table, eos, s.state, {s.riemann_velocity});
  }
}

void run_isentrope(const Options& o, const Material& material) {
  const EquationOfState& eos = *material.eos;
  const State start = state_from(o, eos);
  const End end = end_of(o, 100e9, "kg/m^3");
  const double last = end.is_pressure ? eos::release(eos, start, end.value).end.state.density : end.value;
  CurveTable table = table_of("Isentrope", material, {riemann_column});
  add_isentrope(table, eos, start, last, o.points);
  write(table, o.output);
}

void run_release(const Options& o, const Material& material) {
  const EquationOfState& eos = *material.eos;
  const eos::ShockState shock = shock_from(o, Hugoniot(eos));
  const eos::Release release = eos::release(eos, shock.state, quantity("--to", o.to, "Pa").value_or(0.0));
  CurveTable table = table_of("Release of a shocked state", material, {riemann_column});
  if (release.in_equilibrium) {
    add_row(table, eos, shock.state, {0.0});
    add_row(table, eos, release.end.state, {release.end.riemann_velocity});
  } else {
    add_isentrope(table, eos, shock.state, release.end.state.density, o.points);
  }
  write(table, o.output);
  fmt::print("shock: up {:.4g} km/s, Us {:.4g} km/s", shock.particle_velocity * 1e-3,
             shock.shock_velocity * 1e-3);
  if (!release.in_equilibrium) {
    fmt::print("; velocity of the released surface {:.5g} km/s",
               (shock.particle_velocity - release.end.riemann_velocity) * 1e-3);
  }
  fmt::print("\n");
}

void run_melt(const Options& o, const Material& material) {
  const EquationOfState& eos = *material.eos;
  CurveTable table;
  table.title = fmt::format("Melting curve: {} ({})", material.name, eos.model());
  table.columns = {{"P_GPa", "GPa", 1e9}, {"solidus_K", "K", 1}, {"liquidus_K", "K", 1}};
  const double first = quantity("--from", o.from, "Pa").value_or(0.0),
               last = quantity("--to", o.to, "Pa").value_or(100e9);
  for (const double pressure : spaced(first, last, o.points)) {
    const auto melting = eos::melting_point(eos, pressure);
    if (!melting) throw InputError(fmt::format("model {} of {} does not melt", eos.model(), material.name));
    table.rows.push_back({pressure, melting->solidus.temperature, melting->liquidus.temperature});
  }
  write(table, o.output);
}

void run_dome(const Options& o, const Material& material) {
  const EquationOfState& eos = *material.eos;
  double lower = quantity("--from", o.from, "Pa").value_or(100.0);
  const eos::VapourDome* dome = eos.vapour_dome();
  if (dome == nullptr || !dome->at_pressure(lower)) {
    throw InputError(fmt::format("model {} of {} has no liquid and vapour in equilibrium at {:.4g} Pa",
                                 eos.model(), material.name, lower));
  }
  const double top = 0.999 * dome->critical_point().pressure;
  const double last = std::min(top, quantity("--to", o.to, "Pa").value_or(top));
  CurveTable table;
  table.title = fmt::format("Liquid and vapour in equilibrium: {} ({})", material.name, eos.model());
  table.columns = {{"P_MPa", "MPa", 1e6},
                   {"T_K", "K", 1},
                   {"liquid_kg_m3", "kg/m^3", 1},
                   {"vapour_kg_m3", "kg/m^3", 1},
                   {"latent_kJ_kg", "kJ/kg", 1e3}};
  for (const double x : spaced(std::log(lower), std::log(last), o.points)) {
    const auto s = dome->at_pressure(std::min(std::exp(x), last));
    table.rows.push_back(
        {s->pressure, s->temperature, 1 / s->liquid_volume, 1 / s->vapour_volume, s->latent_heat()});
  }
  write(table, o.output);
  const eos::CriticalPoint& critical = dome->critical_point();
  fmt::print("critical point: {:.5g} K, {:.4g} GPa, {:.4g} g/cm^3\n", critical.temperature,
             critical.pressure * 1e-9, 1e-3 / critical.specific_volume);
}

/// One subcommand: which quantities it takes and what it runs.
struct Query {
  const char* name;
  const char* summary;
  const char* quantities;  ///< of "dtepu" (density, temperature, energy, pressure, particle velocity), "f"
                           ///< from, "o" to
  const char* x;           ///< default columns of the figure
  const char* y;
  void (*run)(const Options&, const Material&);
  const char* example;
};

const Query queries[] = {
    {"state", "One state, from two quantities", "dtep", "rho_kg_m3", "P_GPa", run_state,
     "whipple eos state copper --density '10 g/cm^3' --temperature '3000 K'"},
    {"hugoniot", "Principal Hugoniot, or one shocked state", "dpufo", "up_km_s", "us_km_s", run_hugoniot,
     "whipple eos hugoniot copper --to '300 GPa' --points 31 --csv hugoniot.csv --plot hugoniot.png"},
    {"isotherm", "Pressure and density at constant temperature", "tfo", "V_over_V0", "P_GPa", run_isotherm,
     "whipple eos isotherm copper --temperature '298 K' --to '150 GPa'"},
    {"isentrope", "Isentrope from a state to a pressure or density", "dtepo", "V_over_V0", "P_GPa",
     run_isentrope, "whipple eos isentrope copper --to '200 GPa'"},
    {"release", "Release of a shocked state: residual temperature, melted and vaporised fraction", "dpuo",
     "V_over_V0", "P_GPa", run_release, "whipple eos release copper --pressure '160 GPa' --to '0 Pa'"},
    {"melt", "Solidus and liquidus over pressure", "fo", "P_GPa", "liquidus_K", run_melt,
     "whipple eos melt copper --to '100 GPa'"},
    {"dome", "Liquid and vapour in equilibrium", "fo", "T_K", "P_MPa", run_dome, "whipple eos dome copper"},
};

}  // namespace

void add_eos_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("eos", "States and curves of a material's equation of state");
  command->require_subcommand(1);
  command->footer("Example:\n  whipple eos hugoniot copper --to '300 GPa' --plot hugoniot.png");
  for (const Query& query : queries) {
    auto o = std::make_shared<Options>();
    CLI::App* sub = command->add_subcommand(query.name, query.summary);
    const std::string takes = query.quantities;
    const auto takes_any = [&](char key) { return takes.find(key) != std::string::npos; };
    sub->add_option("material", o->material, "Material file, or name of the library")->required();
    if (takes_any('d')) sub->add_option("--density", o->density, "e.g. '9.5 g/cm^3'");
    if (takes_any('t')) sub->add_option("--temperature", o->temperature, "e.g. '300 K'");
    if (takes_any('e')) sub->add_option("--energy", o->energy, "Specific internal energy, e.g. '1.2 MJ/kg'");
    if (takes_any('p')) sub->add_option("--pressure", o->pressure, "e.g. '100 GPa'");
    if (takes_any('u')) sub->add_option("--particle-velocity", o->particle_velocity, "e.g. '2 km/s'");
    if (takes_any('f')) sub->add_option("--from", o->from, "Begin of the curve, e.g. '10 GPa'");
    if (takes_any('o')) sub->add_option("--to", o->to, "End of the curve, e.g. '150 GPa'");
    sub->add_option("--points", o->points, "Points of the curve")
        ->check(CLI::Range(2, 100000))
        ->capture_default_str();
    sub->add_option("--csv", o->output.csv, "Write the table, units in the names of the columns");
    sub->add_option("--plot", o->output.plot, "Figure, FILE.png");
    o->output.x = query.x;
    o->output.y = query.y;
    sub->add_option("--x", o->output.x, "Column along the figure")->capture_default_str();
    sub->add_option("--y", o->output.y, "Column up the figure")->capture_default_str();
    sub->add_option("--with", o->output.overlay,
                    "CSV files of measurements with the same column names, drawn as points");
    sub->add_flag("--force", o->output.force, "Overwrite existing files");
    sub->footer(fmt::format("Example:\n  {}", query.example));
    sub->callback([o, run = query.run] {
      require_writable(o->output);
      run(*o, read_material(o->material));
    });
  }
  auto name = std::make_shared<std::string>();
  CLI::App* audit = command->add_subcommand(
      "audit", "Is the equation of state sound, and where: limits, stability, identities, verdict");
  audit->add_option("material", *name, "Material file, or name of the library")->required();
  audit->footer("Example:\n  whipple eos audit copper");
  audit->callback([name] { print_audit(read_material(*name)); });
}

}  // namespace whipple::app

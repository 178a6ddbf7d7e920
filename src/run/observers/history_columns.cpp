// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/observers/history_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <tuple>

#include "src/core/base/json.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/solver/accounts.hpp"

namespace whipple::run {
namespace {

using Source = HistorySource;

/// Defines a column of the table; the name of the body is appended to the names of body columns.
struct Column {
  std::string_view name, unit, meaning;
  double (*value)(const Source&);
};
struct BodyColumn {
  std::string_view name, unit, meaning;
  double (*value)(const Source&, std::size_t body);
};

/// Lists the bounds of the time step with their numbers.
std::string_view bounds_text() {
  static const std::string text = [] {
    std::string list = "bound that determined the time step:";
    for (const auto& [bound, name] : words(solver::TimeStepBound{})) {
      list += fmt::format("{} {} {}", bound == solver::TimeStepBound::none ? "" : ",",
                          static_cast<int>(bound), name);
    }
    return list;
  }();
  return text;
}

double stored_energy(const Source& s) { return s.figures.stored_energy + s.figures.chemical_energy; }
double viscous_heat(const Source& s) { return s.ledger.viscous_work + s.ledger.material_viscous_heat; }
double other_heat(const Source& s) {
  const solver::Ledger& sum = s.ledger;
  const double of_hourglass = sum.hourglass_work - s.totals.hourglass_energy - sum.hourglass_overdrawn;
  return sum.transfer_heat + sum.unresolved_returned + sum.contact_heat + sum.friction_heat +
         sum.conversion_heat + of_hourglass;
}

// clang-format off
const auto always = std::to_array<Column>({
    {"step", "", "number of the step", [](const Source& s) { return static_cast<double>(s.state.step); }},
    {"time", "s", "simulated time", [](const Source& s) { return s.state.time; }},
    {"dt", "s", "time step", [](const Source& s) { return s.state.time_step; }},
    {"dt_bound", "1", bounds_text(), [](const Source& s) { return static_cast<double>(s.time_step_bound); }},
    {"mass", "kg", "mass in the domain", [](const Source& s) { return s.totals.mass; }},
    {"kinetic_energy", "J", "kinetic energy of particles and nodes",
     [](const Source& s) { return s.totals.kinetic_energy; }},
    {"affine_kinetic_energy", "J", "kinetic energy of the particles' affine velocity fields",
     [](const Source& s) { return s.totals.affine_kinetic_energy; }},
    {"internal_energy", "J", "internal energy", [](const Source& s) { return s.totals.internal_energy; }},
    {"unresolved_energy", "J", "kinetic energy of motion that the cells do not resolve",
     [](const Source& s) { return s.totals.unresolved_energy; }},
    {"unresolved_share", "1", "unresolved_energy over the kinetic energy of resolved motion",
     [](const Source& s) { return s.totals.unresolved_share(); }},
    {"total_energy", "J", "sum of the energies", [](const Source& s) { return s.totals.energy(); }},
    {"energy_error", "1", "error of the total energy over the energy that the run exchanged",
     [](const Source& s) { return s.ledger.energy_error(s.totals); }},
    {"momentum_x", "kg m/s", "momentum along x", [](const Source& s) { return s.totals.momentum[0]; }},
    {"momentum_y", "kg m/s", "momentum along y", [](const Source& s) { return s.totals.momentum[1]; }},
    {"momentum_z", "kg m/s", "momentum along z", [](const Source& s) { return s.totals.momentum[2]; }},
    {"momentum_error", "1", "error of the momentum over the momentum that the run exchanged",
     [](const Source& s) { return s.ledger.momentum_error(s.totals); }},
    {"angular_momentum_x", "kg m^2/s", "angular momentum about the origin along x, with that of affine fields",
     [](const Source& s) { return s.totals.angular_momentum[0]; }},
    {"angular_momentum_y", "kg m^2/s", "the same along y",
     [](const Source& s) { return s.totals.angular_momentum[1]; }},
    {"angular_momentum_z", "kg m^2/s", "the same along z",
     [](const Source& s) { return s.totals.angular_momentum[2]; }},
});

const auto parts_of_energy = std::to_array<Column>({
    {"elastic_energy", "J", "elastic energy of the deviator, part of the internal energy",
     [](const Source& s) { return s.figures.elastic_energy; }},
    {"stored_energy", "J", "part of the internal energy that cold work, relaxing stress and unburnt explosive hold",
     [](const Source& s) { return stored_energy(s); }},
    {"viscous_heat", "J", "heat of viscosity: artificial (viscous_work), of fluids, of relaxing stress",
     [](const Source& s) { return viscous_heat(s); }},
    {"other_heat", "J", "heat of transfers, contact, friction, conversions and hourglass forces",
     [](const Source& s) { return other_heat(s); }},
    {"volume_energy", "J",
     "the rest of the internal energy: that of the start, and work of the pressure since, less what has left the domain",
     [](const Source& s) {
       return s.totals.internal_energy - s.figures.elastic_energy - stored_energy(s) - s.ledger.plastic_heat -
              viscous_heat(s) - other_heat(s);
     }},
});

const auto of_border_and_phases = std::to_array<Column>({
    {"outflow_mass", "kg", "mass that has left the domain", [](const Source& s) { return s.ledger.outflow.mass; }},
    {"outflow_energy", "J", "energy that has left the domain",
     [](const Source& s) { return s.ledger.outflow.energy(); }},
    {"wall_impulse_x", "N s", "impulse of mirror planes and walls along x",
     [](const Source& s) { return s.ledger.wall_impulse[0]; }},
    {"wall_impulse_y", "N s", "impulse of mirror planes and walls along y",
     [](const Source& s) { return s.ledger.wall_impulse[1]; }},
    {"wall_impulse_z", "N s", "impulse of mirror planes and walls along z",
     [](const Source& s) { return s.ledger.wall_impulse[2]; }},
    {"mass_solid", "kg", "solid mass", [](const Source& s) { return s.all_bodies.mass[0]; }},
    {"mass_melting", "kg", "mass between solid and liquid", [](const Source& s) { return s.all_bodies.mass[1]; }},
    {"mass_liquid", "kg", "liquid mass", [](const Source& s) { return s.all_bodies.mass[2]; }},
    {"mass_vapour", "kg", "mass that is at least half vapour", [](const Source& s) { return s.all_bodies.mass[3]; }},
    {"failed_mass", "kg", "mass that has failed", [](const Source& s) { return s.all_bodies.failed; }},
    {"maximum_speed", "m/s", "maximum speed of a particle or node", [](const Source& s) { return s.figures.speed; }},
    {"maximum_pressure", "Pa", "maximum pressure", [](const Source& s) { return s.figures.pressure; }},
    {"maximum_temperature", "K", "maximum temperature", [](const Source& s) { return s.figures.temperature; }},
    {"squeezed_beside_voids", "kg", "intact mass under pressure in cells that it does not fill",
     [](const Source& s) { return s.state.squeezed_beside_voids; }},
    {"particles", "1", "number of particles", [](const Source& s) { return s.particles; }},
});

const auto of_elements = std::to_array<Column>({
    {"elements", "1", "number of finite elements left", [](const Source& s) { return s.elements; }},
    {"hourglass_energy", "J", "energy stored in hourglass modes",
     [](const Source& s) { return s.totals.hourglass_energy; }},
});

const auto of_cold_work = std::to_array<Column>({
    {"stored_cold_work", "J", "part of the internal energy that plastic work stored without heating",
     [](const Source& s) { return s.figures.stored_cold_work; }},
});

const auto of_load_steps = std::to_array<Column>({
    {"newton_iterations", "1", "iterations of Newton's method in load steps without inertia, since the start of the program",
     [](const Source& s) { return s.equilibrium.iterations; }},
    {"imbalance", "1", "imbalance of the nodes after the load step, over the forces on them",
     [](const Source& s) { return s.equilibrium.residual(); }},
});

const auto of_explosives = std::to_array<Column>({
    {"chemical_energy", "J", "part of the internal energy that unburnt explosive will set free",
     [](const Source& s) { return s.figures.chemical_energy; }},
    {"thermal_energy", "J", "internal energy less the chemical energy",
     [](const Source& s) { return s.totals.internal_energy - s.figures.chemical_energy; }},
});

const auto of_retired = std::to_array<Column>({
    {"retired_mass", "kg", "mass of products that were removed below `burn.retire_below`, part of outflow_mass",
     [](const Source& s) { return s.ledger.retired.mass; }},
    {"retired_momentum_x", "kg m/s", "their momentum along x", [](const Source& s) { return s.ledger.retired.momentum[0]; }},
    {"retired_momentum_y", "kg m/s", "the same along y", [](const Source& s) { return s.ledger.retired.momentum[1]; }},
    {"retired_momentum_z", "kg m/s", "the same along z", [](const Source& s) { return s.ledger.retired.momentum[2]; }},
    {"retired_energy", "J", "their energy, part of outflow_energy", [](const Source& s) { return s.ledger.retired.energy; }},
});

const auto of_bars = std::to_array<Column>({
    {"bars", "1", "number of bars", [](const Source& s) { return s.figures.bars; }},
    {"broken_bars", "1", "bars that have broken", [](const Source& s) { return s.figures.broken_bars; }},
    {"bar_energy", "J", "internal energy of the bars", [](const Source& s) { return s.figures.bar_energy; }},
});

const auto phases_of_body = std::to_array<BodyColumn>({
    {"mass_solid", "kg", "solid mass of the body",
     [](const Source& s, std::size_t b) { return s.by_body[b].mass[0]; }},
    {"mass_melting", "kg", "mass of the body between solid and liquid",
     [](const Source& s, std::size_t b) { return s.by_body[b].mass[1]; }},
    {"mass_liquid", "kg", "liquid mass of the body",
     [](const Source& s, std::size_t b) { return s.by_body[b].mass[2]; }},
    {"mass_vapour", "kg", "mass of the body that is at least half vapour",
     [](const Source& s, std::size_t b) { return s.by_body[b].mass[3]; }},
});

const auto outflow_of_body = std::to_array<BodyColumn>({
    {"outflow_mass", "kg", "mass of the body that has left the domain",
     [](const Source& s, std::size_t b) { return s.state.outflow_of_body[b].mass; }},
    {"outflow_momentum_x", "kg m/s", "momentum along x of what has left",
     [](const Source& s, std::size_t b) { return s.state.outflow_of_body[b].momentum[0]; }},
    {"outflow_momentum_y", "kg m/s", "momentum along y of what has left",
     [](const Source& s, std::size_t b) { return s.state.outflow_of_body[b].momentum[1]; }},
    {"outflow_momentum_z", "kg m/s", "momentum along z of what has left",
     [](const Source& s, std::size_t b) { return s.state.outflow_of_body[b].momentum[2]; }},
    {"outflow_energy", "J", "energy of what has left",
     [](const Source& s, std::size_t b) { return s.state.outflow_of_body[b].energy; }},
});
// clang-format on

constexpr std::string_view limits_are =
    "Limits applied to the material or the time step, counted over all particles and steps so far; shown at "
    "the end of a run\n"
    "and in its report if there were any:\n";

/// Holds the components of a run that determine the columns of its file.
struct Parts {
  bool elements = false, cold_work = false, explosives = false, retired = false, bars = false,
       damping = false, load_steps = false, levels = false;
  std::vector<std::string> bodies;
};

std::vector<HistoryColumn> columns_of(const Parts& parts) {
  std::vector<HistoryColumn> columns;
  const auto add = [&](std::span<const Column> group) {
    for (const Column& c : group)
      columns.push_back({std::string(c.name), std::string(c.unit), std::string(c.meaning), c.value});
  };
  const auto add_for_bodies = [&](std::span<const BodyColumn> group) {
    for (std::size_t b = 0; b < parts.bodies.size(); ++b) {
      for (const BodyColumn& c : group) {
        columns.push_back({fmt::format("{}.{}", c.name, parts.bodies[b]), std::string(c.unit),
                           std::string(c.meaning),
                           [value = c.value, b](const Source& s) { return value(s, b); }});
      }
    }
  };
  const auto add_accounts = [&](solver::Shown shown) {
    for (const solver::Account& account : solver::accounts) {
      if (account.shown != shown) continue;
      columns.push_back(
          {account.name, account.unit,
           (solver::is_limiter(shown) ? std::string("times: ") : std::string()) + account.meaning,
           [sum = account.sum](const Source& s) { return s.ledger.*sum; }});
    }
  };
  add(always);
  add(parts_of_energy);
  add_accounts(solver::Shown::always);
  if (parts.damping) add_accounts(solver::Shown::of_damping);
  add(of_border_and_phases);
  add_accounts(solver::Shown::limiter);
  if (parts.levels) add_accounts(solver::Shown::of_levels);
  if (parts.elements) {
    add(of_elements);
    add_accounts(solver::Shown::of_elements);
  }
  if (parts.load_steps) add(of_load_steps);
  if (parts.cold_work) add(of_cold_work);
  if (parts.explosives) add(of_explosives);
  if (parts.retired) add(of_retired);
  if (parts.bars) add(of_bars);
  add_for_bodies(phases_of_body);
  add_for_bodies(outflow_of_body);
  return columns;
}

bool stores_cold_work(const cases::Case& setup) {
  return std::ranges::any_of(setup.materials,
                             [](const auto& material) { return material->stores_cold_work(); });
}

}  // namespace

HistorySource::HistorySource(const solver::Simulation& simulation)
    : state(simulation.state()),
      ledger(state.ledger),
      totals(simulation.totals()),
      time_step_bound(simulation.time_step_bound()),
      equilibrium(simulation.equilibrium()),
      by_body(simulation.setup().bodies.size()),
      particles(static_cast<double>(simulation.particle_count())),
      elements(static_cast<double>(simulation.element_count())) {
  simulation.add_figures(by_body, figures);
  solver::sum_over_ranks(simulation.communicator(), by_body);
  for (const solver::PhaseMasses& body : by_body) all_bodies += body;

  std::array<double, 3> maxima = {figures.speed, figures.pressure, figures.temperature};
  parallel::maximum(simulation.communicator(), maxima);
  std::tie(figures.speed, figures.pressure, figures.temperature) = std::tuple_cat(maxima);
  std::array<double, 7> sums = {figures.elastic_energy,  figures.stored_energy, figures.stored_cold_work,
                                figures.chemical_energy, figures.bars,          figures.broken_bars,
                                figures.bar_energy};
  parallel::sum(simulation.communicator(), sums);
  std::tie(figures.elastic_energy, figures.stored_energy, figures.stored_cold_work, figures.chemical_energy,
           figures.bars, figures.broken_bars, figures.bar_energy) = std::tuple_cat(sums);
}

std::vector<HistoryColumn> history_columns(const cases::Case& setup) {
  Parts parts{.elements = setup.has_elements(),
              .cold_work = stores_cold_work(setup),
              .explosives = setup.has_burn(),
              .retired = setup.burn.retire_below > 0.0,
              .bars = setup.has_bars(),
              .damping = setup.damping.coefficient > 0.0,
              .load_steps = !cases::has_inertia(setup.time.scheme),
              .levels = !setup.domain.refinement.empty(),
              .bodies = {}};
  for (const cases::Body& body : setup.bodies) parts.bodies.push_back(body.name);
  return columns_of(parts);
}

std::string history_columns_as_markdown() {
  std::string text;
  for (const HistoryColumn& column : columns_of({true, true, true, true, true, true, true, true, {"BODY"}})) {
    text += fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, column.meaning);
  }
  return text;
}

std::string accounts_as_markdown() {
  std::string energies = "| column | taken by | into |\n| --- | --- | --- |\n";
  std::string limits = "| column | counts | reason of the limit |\n| --- | --- | --- |\n";
  for (const solver::Account& a : solver::accounts) {
    if (!a.taken_by.empty()) energies += fmt::format("| `{}` | {} | {} |\n", a.name, a.taken_by, a.taken_to);
    if (solver::is_limiter(a.shown))
      limits += fmt::format("| `{}` | {} | {} |\n", a.name, a.meaning, a.reason);
  }
  return fmt::format("{}\n{}\n{}", energies, limits_are, limits);
}

std::string columns_as_json(std::span<const HistoryColumn> columns) {
  using nlohmann::json;
  json list = json::array();
  for (const HistoryColumn& column : columns) {
    list.push_back({{"name", column.name}, {"unit", column.unit}, {"meaning", column.meaning}});
    const auto account = std::ranges::find(solver::accounts, column.name, &solver::Account::name);
    if (account == solver::accounts.end()) continue;
    if (solver::is_limiter(account->shown)) list.back()["limiter"] = account->meaning;
    if (account->taken_by.empty()) continue;
    list.back()["taken_by"] = account->taken_by;
    list.back()["taken_to"] = account->taken_to;
  }
  return json_text(list, 1) + "\n";
}

std::vector<io::HistoryValue> history_row(std::span<const HistoryColumn> columns,
                                          const solver::Simulation& simulation) {
  const HistorySource source(simulation);
  std::vector<io::HistoryValue> row;
  row.reserve(columns.size());
  for (const HistoryColumn& column : columns) row.push_back({column.name, column.unit, column.value(source)});
  return row;
}

}  // namespace whipple::run

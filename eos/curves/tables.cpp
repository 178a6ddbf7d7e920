// SPDX-License-Identifier: BSD-3-Clause
#include "eos/curves/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eos/inversions.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos::curves {
namespace {

constexpr double GPa = 1e9;  // Pa

Column pressure_column() { return quantity_column("P_GPa", "GPa", "Pa", "pressure"); }
Column particle_velocity_column() { return quantity_column("up_km_s", "km/s", "m/s", "particle velocity"); }
Column shock_velocity_column() { return quantity_column("us_km_s", "km/s", "m/s", "shock velocity"); }
Column speed_column(std::string name, std::string meaning) {
  return quantity_column(std::move(name), "km/s", "m/s", std::move(meaning));
}
Column riemann_column() { return quantity_column("u_km_s", "km/s", "m/s", "Riemann velocity"); }

/// Makes a table without rows.
CurveTable table_of(const std::string& title, const Subjects& subjects, std::vector<Column> columns) {
  CurveTable table;
  table.title = title;
  if (subjects.size() == 1)
    table.title += fmt::format(": {} ({})", subjects[0].name, subjects[0].eos->model());
  table.columns = std::move(columns);
  for (const Subject& subject : subjects) table.series.push_back({subject.name, {}});
  return table;
}

/// Inserts columns before those of a state.
std::vector<Column> before_state(std::vector<Column> columns) {
  columns.insert(columns.end(), state_columns().begin(), state_columns().end());
  return columns;
}

CurveRow row_of(const EquationOfState& eos, const State& state, CurveRow leading = {}) {
  for (const Cell& cell : state_cells(state, eos)) leading.push_back(cell);
  return leading;
}

CurveRow shock_row(const EquationOfState& eos, const ShockState& s) {
  return row_of(eos, s.state, {s.particle_velocity, s.shock_velocity});
}

/// Adds the rows of a curve over values. The curve is truncated where the model is no longer valid; a model without
/// any row is an error.
template <class Row>
void fill(Series& series, const std::vector<double>& values, const Row& row) {
  for (const double value : values) {
    try {
      series.rows.push_back(row(value));
    } catch (const StateError& error) {
      if (series.rows.empty()) throw;
      series.end = error.what();
      return;
    }
  }
}

/// Adds an isentrope at equal ratios of density, beginning at its start.
void add_isentrope(Series& series, const EquationOfState& eos, const State& start, double last_density,
                   int points) {
  std::vector<double> densities;
  for (const double x : spaced(std::log(start.density), std::log(last_density), points)) {
    densities.push_back(std::exp(x));
  }
  for (const IsentropeState& s : isentrope(eos, start, densities)) {
    series.rows.push_back(row_of(eos, s.state, {s.riemann_velocity}));
  }
}

std::string title_of(const HugoniotStart& start) {
  if (start.reflected_pressure) {
    return fmt::format("Hugoniot from the state shocked to {:.6g} GPa", *start.reflected_pressure / GPa);
  }
  if (start.initial_density) return fmt::format("Hugoniot from {:.6g} g/cm^3", *start.initial_density * 1e-3);
  return "Principal Hugoniot";
}

}  // namespace

CurveTable state_table(const Subjects& subjects, std::span<const StateQuery> queries) {
  CurveTable table = table_of("State", subjects, state_columns());
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const EquationOfState& eos = *subjects[i].eos;
    for (const StateQuery& query : queries) table.series[i].rows.push_back(row_of(eos, state_of(eos, query)));
  }
  return table;
}

CurveTable hugoniot_table(const Subjects& subjects, const HugoniotStart& start, const ShockQuery& query,
                          Variable variable, const CurveRange& range) {
  if (variable == Variable::density) throw InputError("a Hugoniot runs over pressure or particle velocity");
  const bool over_pressure = variable == Variable::pressure;
  if (!over_pressure && !range.to) throw InputError("a Hugoniot over particle velocity needs its last one");
  const double first = range.from.value_or(0.0), last = range.to.value_or(200 * GPa);
  if (first < 0 || last < 0)
    throw InputError("a shock compresses: a Hugoniot begins and ends at zero or above");
  CurveTable table = table_of(title_of(start), subjects,
                              before_state({particle_velocity_column(), shock_velocity_column()}));
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const EquationOfState& eos = *subjects[i].eos;
    const Hugoniot hugoniot = hugoniot_of(eos, start);
    if (const auto shock = shock_of(hugoniot, query)) {
      table.series[i].rows.push_back(shock_row(eos, *shock));
      continue;
    }
    const double begin = over_pressure ? std::max(first, hugoniot.initial().pressure) : first;
    if (begin > last) {
      const char* unit = over_pressure ? "Pa" : "m/s";
      throw InputError(
          fmt::format("the curve begins at {:.4g} {}, beyond its end at {:.4g} {}", begin, unit, last, unit));
    }
    fill(table.series[i], spaced(begin, last, range.points), [&](double value) {
      return shock_row(eos,
                       over_pressure ? hugoniot.at_pressure(value) : hugoniot.at_particle_velocity(value));
    });
  }
  return table;
}

CurveTable isotherm_table(const Subjects& subjects, std::optional<double> temperature,
                          const CurveRange& range) {
  CurveTable table = table_of(
      temperature ? fmt::format("Isotherm at {} K", *temperature) : "Isotherm at the reference temperature",
      subjects, state_columns());
  const double first = range.from.value_or(0.0), last = range.to.value_or(100 * GPa);
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const EquationOfState& eos = *subjects[i].eos;
    const double T = temperature.value_or(eos.reference_temperature());
    std::optional<double> density;
    fill(table.series[i], spaced(first, last, range.points), [&](double pressure) {
      const State s = state_at_pressure_and_temperature(eos, pressure, T, density);
      density = s.density;
      return row_of(eos, s);
    });
  }
  return table;
}

CurveTable isentrope_table(const Subjects& subjects, const StateQuery& start, Variable variable,
                           const CurveRange& range) {
  if (variable == Variable::particle_velocity) throw InputError("an isentrope runs over pressure or density");
  const bool over_pressure = variable == Variable::pressure;
  if (!over_pressure && !range.to) throw InputError("an isentrope over density needs its last one");
  CurveTable table = table_of("Isentrope", subjects, before_state({riemann_column()}));
  const double last = range.to.value_or(100 * GPa);
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const EquationOfState& eos = *subjects[i].eos;
    const State begin = state_of(eos, start);
    const double density = over_pressure ? isentrope_at_pressure(eos, begin, last).state.density : last;
    add_isentrope(table.series[i], eos, begin, density, range.points);
  }
  return table;
}

CurveTable release_table(const Subjects& subjects, const HugoniotStart& start, const ShockQuery& query,
                         const CurveRange& range) {
  CurveTable table = table_of("Release of a shocked state", subjects, before_state({riemann_column()}));
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const EquationOfState& eos = *subjects[i].eos;
    const State shocked = required_shock(eos, start, query).state;
    const Release end = release(eos, shocked, range.to.value_or(0.0));
    if (end.in_equilibrium) {
      table.series[i].rows.push_back(row_of(eos, shocked, {0.0}));
      table.series[i].rows.push_back(row_of(eos, end.end.state, {end.end.riemann_velocity}));
    } else {
      add_isentrope(table.series[i], eos, shocked, end.end.state.density, range.points);
    }
  }
  return table;
}

CurveTable cold_table(const Subjects& subjects, const CurveRange& range) {
  CurveTable table = table_of("Cold curve", subjects, state_columns());
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const EquationOfState& eos = *subjects[i].eos;
    const double rho0 = eos.reference_density();
    const double first = range.from.value_or(0.9 * rho0);
    const double last = range.to.value_or(std::min(1.5 * rho0, eos.maximum_density()));
    fill(table.series[i], spaced(first, last, range.points),
         [&](double density) { return row_of(eos, cold_state(eos, density)); });
  }
  return table;
}

CurveTable melt_table(const Subjects& subjects, const CurveRange& range) {
  CurveTable table =
      table_of("Melting line", subjects,
               {pressure_column(), quantity_column("solidus_K", "K", "K", "temperature of the solidus"),
                quantity_column("liquidus_K", "K", "K", "temperature of the liquidus"),
                quantity_column("solid_kg_m3", "kg/m^3", "kg/m^3", "density of the solid"),
                quantity_column("liquid_kg_m3", "kg/m^3", "kg/m^3", "density of the liquid")});
  const double first = range.from.value_or(0.0), last = range.to.value_or(100 * GPa);
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const EquationOfState& eos = *subjects[i].eos;
    fill(table.series[i], spaced(first, last, range.points), [&](double pressure) {
      const auto melting = melting_point(eos, pressure);
      if (!melting)
        throw StateError(fmt::format("model {} of {} does not melt", eos.model(), subjects[i].name));
      return CurveRow{pressure, melting->solidus.temperature, melting->liquidus.temperature,
                      melting->solidus.density, melting->liquidus.density};
    });
  }
  return table;
}

CurveTable dome_table(const Subjects& subjects, const CurveRange& range) {
  CurveTable table = table_of(
      "Liquid and vapour in equilibrium", subjects,
      {quantity_column("P_MPa", "MPa", "Pa", "pressure"), quantity_column("T_K", "K", "K", "temperature"),
       quantity_column("liquid_kg_m3", "kg/m^3", "kg/m^3", "density of the liquid"),
       quantity_column("vapour_kg_m3", "kg/m^3", "kg/m^3", "density of the vapour"),
       quantity_column("latent_kJ_kg", "kJ/kg", "J/kg", "enthalpy of vaporisation")});
  const double lower = range.from.value_or(100.0);
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const EquationOfState& eos = *subjects[i].eos;
    const VapourDome* dome = eos.vapour_dome();
    if (dome == nullptr || !dome->at_pressure(lower)) {
      throw InputError(fmt::format("model {} of {} has no liquid and vapour in equilibrium at {:.4g} Pa",
                                   eos.model(), subjects[i].name, lower));
    }
    const double top = 0.999 * dome->critical_point().pressure;
    const double last = std::min(top, range.to.value_or(top));
    for (const double x : spaced(std::log(lower), std::log(last), range.points)) {
      const auto s = dome->at_pressure(std::min(std::exp(x), last));
      table.series[i].rows.push_back(
          {s->pressure, s->temperature, 1 / s->liquid_volume, 1 / s->vapour_volume, s->latent_heat()});
    }
  }
  return table;
}

CurveTable match_table(const Subjects& subjects, double velocity) {
  const std::vector<ImpedanceMatch> matches = interfaces(subjects, velocity);
  CurveTable table;
  table.title =
      fmt::format("Impact of {} on {} with {:.6g} km/s", subjects[0].name, subjects[1].name, velocity * 1e-3);
  table.columns = before_state({plain_column("interface", "interface"),
                                quantity_column("u_km_s", "km/s", "m/s", "velocity of the interface"),
                                shock_velocity_column()});
  table.series.push_back({"", {}});
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const ImpedanceMatch& m = matches[i];
    const std::string arrow = std::isnan(m.left_shock_velocity) ? " (released)" : " (shocked)";
    table.series[0].rows.push_back(
        row_of(*subjects[i].eos, m.left, {subjects[i].name + arrow, m.velocity, m.left_shock_velocity}));
    table.series[0].rows.push_back(
        row_of(*subjects[i + 1].eos, m.right,
               {subjects[i + 1].name + " (shocked)", m.velocity, m.right_shock_velocity}));
  }
  return table;
}

CurveTable detonation_table(const Subjects& explosives) {
  CurveTable table =
      table_of("Chapman-Jouguet state", explosives,
               before_state({quantity_column("D_km_s", "km/s", "m/s", "detonation velocity"),
                             particle_velocity_column(), plain_column("exponent", "adiabatic exponent"),
                             speed_column("gurney_km_s", "Gurney velocity, sevenfold volume")}));
  for (std::size_t i = 0; i < explosives.size(); ++i) {
    const DetonationProducts products(*explosives[i].eos);
    const ChapmanJouguet& cj = products.chapman_jouguet();
    table.series[i].rows.push_back(row_of(*explosives[i].eos, cj.state,
                                          {cj.detonation_velocity, cj.particle_velocity,
                                           products.adiabatic_exponent(), products.gurney_velocity()}));
  }
  return table;
}

CurveTable products_table(const Subjects& explosives, Variable variable, const CurveRange& range) {
  if (variable == Variable::particle_velocity) throw InputError("an isentrope runs over pressure or density");
  constexpr double greatest_volume = 100;
  CurveTable table =
      table_of("Isentrope of detonation products", explosives,
               before_state({riemann_column(), plain_column("energy_left", "fraction of the energy left")}));
  for (std::size_t i = 0; i < explosives.size(); ++i) {
    const EquationOfState& eos = *explosives[i].eos;
    const DetonationProducts products(eos);
    const State& cj = products.chapman_jouguet().state;
    double last = eos.reference_density() / greatest_volume;
    if (range.to)
      last =
          variable == Variable::density ? *range.to : isentrope_at_pressure(eos, cj, *range.to).state.density;
    std::vector<double> volumes;
    for (const double x : spaced(std::log(cj.density), std::log(last), range.points)) {
      volumes.push_back(eos.reference_density() / std::exp(x));
    }
    for (const IsentropeState& s : products.expansion(volumes)) {
      const double left = 1 - products.energy_given_off(s.state) / eos.reference_energy();
      table.series[i].rows.push_back(row_of(eos, s.state, {s.riemann_velocity, left}));
    }
  }
  return table;
}

CurveTable contact_table(const Subjects& subjects) {
  if (subjects.size() < 2) throw InputError("a contact has an explosive, and an inert material at least");
  const DetonationProducts products(*subjects[0].eos);
  CurveTable table;
  table.title = fmt::format("Detonation of {} meets", subjects[0].name);
  table.columns = before_state(
      {plain_column("material", "material"), plain_column("wave", "wave back into the products"),
       quantity_column("u_km_s", "km/s", "m/s", "velocity of the interface"), shock_velocity_column()});
  table.series.push_back({"", {}});
  for (std::size_t i = 1; i < subjects.size(); ++i) {
    const ImpedanceMatch m = products.contact(Hugoniot(*subjects[i].eos));
    table.series[0].rows.push_back(
        row_of(*subjects[i].eos, m.right,
               {subjects[i].name, std::isnan(m.left_shock_velocity) ? "expansion" : "shock", m.velocity,
                m.right_shock_velocity}));
  }
  return table;
}

CurveTable gurney_table(const Subjects& explosives, double volume, int points) {
  CurveTable table = table_of(fmt::format("Gurney speeds at {:.6g} volumes", volume), explosives,
                              {plain_column("metal_over_explosive", "mass of metal over that of explosive")});
  for (const auto& [word, shape] : gurney_shapes) {
    table.columns.push_back(
        speed_column(std::string(word) + "_km_s", std::string("speed of the metal, ") + word));
  }
  for (std::size_t i = 0; i < explosives.size(); ++i) {
    const double velocity = DetonationProducts(*explosives[i].eos).gurney_velocity(volume);
    for (const double x : spaced(std::log(0.1), std::log(10.0), points)) {
      CurveRow row = {std::exp(x)};
      for (const auto& [word, shape] : gurney_shapes)
        row.emplace_back(gurney_speed(shape, velocity, std::exp(x)));
      table.series[i].rows.push_back(std::move(row));
    }
  }
  return table;
}

CurveTable cylinder_table(const Subjects& explosives, const CylinderTest& test, const CurveRange& range) {
  CurveTable table = table_of(fmt::format("Cylinder test, bore {:.4g} mm, wall {:.4g} mm of {:.6g} kg/m^3",
                                          2e3 * test.inner_radius, 1e3 * test.wall, test.wall_density),
                              explosives,
                              {quantity_column("R_R0_mm", "mm", "m", "displacement of the outer surface"),
                               speed_column("radial_km_s", "radial speed of the outer surface"),
                               speed_column("wall_km_s", "speed of the wall"),
                               quantity_column("angle_degree", "degree", "rad", "angle of the wall"),
                               plain_column("v", "relative volume of the products"), pressure_column()});
  for (std::size_t i = 0; i < explosives.size(); ++i) {
    const DetonationProducts products(*explosives[i].eos);
    const std::vector<double> displacements =
        spaced(range.from.value_or(1e-3), range.to.value_or(25e-3), range.points);
    for (const CylinderWall& w : cylinder_test(products, test, displacements)) {
      table.series[i].rows.push_back(
          {w.displacement, w.radial_speed, w.material_speed, w.angle, w.volume, w.pressure});
    }
  }
  return table;
}

}  // namespace whipple::eos::curves

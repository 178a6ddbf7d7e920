// SPDX-License-Identifier: BSD-3-Clause
#include "eos/curves/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::eos::curves {

Column quantity_column(std::string name, std::string unit, const std::string& si_unit, std::string meaning,
                       bool in_curves) {
  const double size = units::conversion(unit, si_unit).factor;
  return {std::move(name), std::move(unit), size, std::move(meaning), in_curves};
}

Column plain_column(std::string name, std::string meaning) {
  return {std::move(name), "", 1.0, std::move(meaning)};
}

const std::vector<Column>& state_columns() {
  static const std::vector<Column> columns = {
      quantity_column("rho_kg_m3", "kg/m^3", "kg/m^3", "density"),
      plain_column("V_over_V0", "relative volume V/V0"),
      quantity_column("P_GPa", "GPa", "Pa", "pressure"),
      quantity_column("T_K", "K", "K", "temperature"),
      quantity_column("e_kJ_kg", "kJ/kg", "J/kg", "specific internal energy"),
      quantity_column("c_km_s", "km/s", "m/s", "sound speed"),
      quantity_column("s_J_kg_K", "J/(kg K)", "J/(kg K)", "specific entropy"),
      quantity_column("cv_J_kg_K", "J/(kg K)", "J/(kg K)", "heat capacity at constant volume"),
      plain_column("gamma", "Grüneisen parameter"),
      quantity_column("KT_GPa", "GPa", "Pa", "isothermal bulk modulus"),
      quantity_column("KS_GPa", "GPa", "Pa", "isentropic bulk modulus", false),
      quantity_column("cp_J_kg_K", "J/(kg K)", "J/(kg K)", "heat capacity at constant pressure", false),
      quantity_column("alpha_1e-6_K", "1e-6/K", "1/K", "volume expansion at constant pressure", false),
      quantity_column("F_kJ_kg", "kJ/kg", "J/kg", "Helmholtz energy", false),
      quantity_column("G_kJ_kg", "kJ/kg", "J/kg", "Gibbs energy", false),
      plain_column("melted", "mass fraction of liquid and vapour"),
      plain_column("vaporised", "mass fraction of vapour"),
      plain_column("phase", "phase")};
  return columns;
}

const Column& state_column(const std::string& name) {
  const auto found = std::ranges::find(state_columns(), name, &Column::name);
  if (found == state_columns().end()) throw InternalError(fmt::format("no column {} of a state", name));
  return *found;
}

CurveRow state_cells(const State& s, const EquationOfState& eos) {
  return {s.density,
          eos.reference_density() / s.density,
          s.pressure,
          s.temperature,
          s.specific_internal_energy,
          s.sound_speed,
          s.specific_entropy,
          s.heat_capacity,
          s.gruneisen,
          s.isothermal_bulk_modulus,
          s.isentropic_bulk_modulus,
          s.isobaric_heat_capacity,
          s.thermal_expansion,
          s.helmholtz_energy,
          s.gibbs_energy,
          s.melted_fraction,
          s.vaporised_fraction,
          std::string(s.phase)};
}

std::size_t column_index(const CurveTable& table, const std::string& name) {
  const auto found = std::ranges::find(table.columns, name, &Column::name);
  if (found != table.columns.end()) return static_cast<std::size_t>(found - table.columns.begin());
  std::vector<std::string> names;
  for (const Column& column : table.columns) names.push_back(column.name);
  throw InputError(fmt::format("no column '{}'; the columns are {}", name, fmt::join(names, ", ")));
}

std::vector<double> spaced(double from, double to, int points) {
  std::vector<double> values;
  for (int i = 0; i < points; ++i) values.push_back(points > 1 ? from + (to - from) * i / (points - 1) : to);
  return values;
}

}  // namespace whipple::eos::curves

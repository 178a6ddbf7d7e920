// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string_view>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/option_quantity.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/units.hpp"
#include "src/material/strength/foam.hpp"

namespace whipple::app {
namespace {

using eos::curves::Variable;

const char* unit_of(Variable variable) {
  switch (variable) {
    case Variable::pressure:
      return "Pa";
    case Variable::particle_velocity:
      return "m/s";
    case Variable::density:
      return "kg/m^3";
  }
  throw InternalError("unknown variable of a curve");
}

/// Returns the range of a quantity by its unit: densities and temperatures are positive, velocities of shocks and
/// particles are not negative, and energies, pressures and entropies have no bound.
Range admissible(std::string_view unit) {
  static const std::map<std::string_view, Range> ranges = {
      {"kg/m^3", range::positive()}, {"K", range::positive()}, {"m/s", range::non_negative()}};
  const auto found = ranges.find(unit);
  return found == ranges.end() ? range::any() : found->second;
}

bool is_in(const std::string& text, const char* unit) {
  try {
    static_cast<void>(units::parse_quantity(text, unit));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::optional<double> quantity(const char* option, const std::string& text, const char* unit) {
  if (text.empty()) return std::nullopt;
  return option_quantity(option, text, unit, admissible(unit));
}

eos::curves::StateQuery state_query(const EosOptions& o) {
  return {quantity("--density", o.density, "kg/m^3"), quantity("--temperature", o.temperature, "K"),
          quantity("--energy", o.energy, "J/kg"), quantity("--pressure", o.pressure, "Pa"),
          quantity("--entropy", o.entropy, "J/(kg K)")};
}

namespace {

/// Describes a column of a list of states.
struct StateColumn {
  const char* name;
  const char* unit;
  std::optional<double> eos::curves::StateQuery::* value;
};
constexpr std::array<StateColumn, 5> state_columns = {{
    {"density", "kg/m^3", &eos::curves::StateQuery::density},
    {"temperature", "K", &eos::curves::StateQuery::temperature},
    {"energy", "J/kg", &eos::curves::StateQuery::energy},
    {"pressure", "Pa", &eos::curves::StateQuery::pressure},
    {"entropy", "J/(kg K)", &eos::curves::StateQuery::entropy},
}};

/// Holds a column with the unit that the file gives for it.
struct StatedColumn {
  const StateColumn* column;
  std::string unit;
};

StatedColumn column_of(const std::string& head) {
  const std::size_t bracket = std::min(head.find(" ["), head.size());
  const std::string name = head.substr(0, bracket);
  const auto found =
      std::ranges::find_if(state_columns, [&](const StateColumn& c) { return name == c.name; });
  if (found == state_columns.end()) {
    std::vector<std::string> known;
    for (const StateColumn& column : state_columns) known.emplace_back(column.name);
    throw InputError(fmt::format("unknown column {}{}; known: {}", toml_string(name),
                                 did_you_mean(name, known), fmt::join(known, ", ")));
  }
  if (bracket == head.size()) return {&*found, found->unit};
  return {&*found, head.substr(bracket + 2, head.find(']', bracket) - bracket - 2)};
}

}  // namespace

std::vector<eos::curves::StateQuery> state_queries(const EosOptions& o) {
  if (o.states.empty()) return {state_query(o)};
  std::istringstream file(read_text(o.states));
  std::vector<StatedColumn> columns;
  std::vector<eos::curves::StateQuery> queries;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    if (++number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') continue;
    try {
      const std::vector<std::string> cells = csv_cells(line);
      if (columns.empty()) {
        for (const std::string& cell : cells) {
          const StatedColumn column = column_of(cell);
          if (std::ranges::find(columns, column.column, &StatedColumn::column) != columns.end())
            throw InputError(fmt::format("a second column \"{}\"", column.column->name));
          columns.push_back(column);
        }
        continue;
      }
      if (cells.size() != columns.size())
        throw InputError(fmt::format("{} cells for {} columns", cells.size(), columns.size()));
      eos::curves::StateQuery& query = queries.emplace_back();
      int given = 0;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const StateColumn& column = *columns[i].column;
        if (cells[i].empty()) continue;
        query.*column.value = quantity(column.name, cells[i] + " " + columns[i].unit, column.unit);
        ++given;
      }
      if (given != 2) throw InputError(fmt::format("{} quantities, but a state is named by two", given));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}:{}: {}", o.states, number, error.what()));
    }
  }
  if (queries.empty()) throw InputError(fmt::format("{}: lists no states", o.states));
  return queries;
}

eos::curves::HugoniotStart hugoniot_start(const EosOptions& o) {
  return {quantity("--initial-density", o.initial_density, "kg/m^3"),
          quantity("--reflected", o.reflected, "Pa")};
}

eos::curves::ShockQuery shock_query(const EosOptions& o) {
  return {quantity("--density", o.density, "kg/m^3"), quantity("--pressure", o.pressure, "Pa"),
          quantity("--particle-velocity", o.particle_velocity, "m/s")};
}

Variable curve_variable(const EosOptions& o, std::span<const Variable> variables) {
  if (o.to.empty()) return variables.front();
  std::string known;
  for (const Variable variable : variables) {
    if (is_in(o.to, unit_of(variable))) return variable;
    known += fmt::format("{}{}", known.empty() ? "" : " or in ", unit_of(variable));
  }
  throw InputError(fmt::format("--to: '{}': expected a quantity in {}", o.to, known));
}

eos::curves::CurveRange curve_range(const EosOptions& o, Variable variable) {
  return {quantity("--from", o.from, unit_of(variable)), quantity("--to", o.to, unit_of(variable)), o.points};
}

double impact_velocity(const EosOptions& o) {
  const auto velocity = quantity("--velocity", o.velocity, "m/s");
  if (!velocity || *velocity == 0)
    throw InputError("an impact needs a --velocity above zero, e.g. --velocity '5 km/s'");
  return *velocity;
}

void refuse_foam(const Material& material) {
  if (dynamic_cast<const strength::Foam*>(material.strength.get()) == nullptr) return;
  throw InputError(fmt::format(
      "material \"{}\" is a foam, which its strength model \"{}\" crushes: its states do not follow "
      "from the equation of state, which is that of the solid; name the solid instead",
      material.name, material.strength->model()));
}

eos::curves::Subjects subjects_of(std::span<const Material> materials) {
  eos::curves::Subjects subjects;
  for (const Material& material : materials) {
    refuse_foam(material);
    subjects.push_back({material.name, material.eos});
  }
  return subjects;
}

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#include "src/shields/shots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/units.hpp"
#include "src/shields/alloys.hpp"

namespace whipple::shields {
namespace {

enum class Need : std::uint8_t { required, optional };

/// Describes a column: a number with a unit, or a text (no unit).
struct Known {
  std::string_view name;
  std::string_view unit;  ///< SI
  Need need;
  Range range;
  std::function<void(Shot&, double)> number;
  std::function<void(Shot&, const std::string&)> text;
};

Bumper& bumper_of(Shot& shot) { return shot.impact.shield.bumpers.front(); }

Result result_of(const std::string& word) {
  if (const std::optional<Result> result = value_of<Result>(word)) return *result;
  throw InputError(
      fmt::format("result is \"{}\" (accepted: P: perforated or detached spall, NP: neither)", word));
}

/// Checks an alloy and returns it.
std::string known_alloy(const std::string& name) { return std::string(alloy_named(name).name); }

const std::vector<Known>& known_columns() {
  using enum Need;
  const Range positive = range::positive();
  const Range angles = {.lower = 0.0, .upper = 0.5 * std::numbers::pi, .upper_open = true};
  static const std::vector<Known> all = {
      {"shot", "", optional, {}, {}, [](Shot& s, const std::string& t) { s.impact.name = t; }},
      {"source", "", optional, {}, {}, [](Shot& s, const std::string& t) { s.source = t; }},
      {"sphere",
       "",
       required,
       {},
       {},
       [](Shot& s, const std::string& t) { s.impact.projectile.alloy = known_alloy(t); }},
      {"sphere density",
       "kg/m^3",
       optional,
       positive,
       [](Shot& s, double x) { s.impact.projectile.density = x; },
       {}},
      {"diameter", "m", required, positive, [](Shot& s, double x) { s.impact.projectile.diameter = x; }, {}},
      {"angle", "rad", optional, angles, [](Shot& s, double x) { s.impact.projectile.angle = x; }, {}},
      {"velocity",
       "m/s",
       required,
       positive,
       [](Shot& s, double x) { s.impact.projectile.velocity = x; },
       {}},
      {"bumper",
       "",
       required,
       {},
       {},
       [](Shot& s, const std::string& t) { bumper_of(s).sheet.alloy = known_alloy(t); }},
      {"bumper density",
       "kg/m^3",
       optional,
       positive,
       [](Shot& s, double x) { bumper_of(s).sheet.density = x; },
       {}},
      {"bumper thickness",
       "m",
       required,
       positive,
       [](Shot& s, double x) { bumper_of(s).sheet.thickness = x; },
       {}},
      {"spacing", "m", required, positive, [](Shot& s, double x) { bumper_of(s).spacing = x; }, {}},
      {"wall",
       "",
       required,
       {},
       {},
       [](Shot& s, const std::string& t) { s.impact.shield.wall.alloy = known_alloy(t); }},
      {"wall density",
       "kg/m^3",
       optional,
       positive,
       [](Shot& s, double x) { s.impact.shield.wall.density = x; },
       {}},
      {"wall yield", "Pa", optional, positive, [](Shot& s, double x) { s.impact.shield.wall.yield = x; }, {}},
      {"wall thickness",
       "m",
       required,
       positive,
       [](Shot& s, double x) { s.impact.shield.wall.thickness = x; },
       {}},
      {"foam density",
       "kg/m^3",
       optional,
       positive,
       [](Shot& s, double x) { s.impact.shield.foam.density = x; },
       {}},
      {"foam cell", "m", optional, positive, [](Shot& s, double x) { s.impact.shield.foam.cell = x; }, {}},
      {"result", "", optional, {}, {}, [](Shot& s, const std::string& t) { s.result = result_of(t); }},
  };
  return all;
}

/// Holds a column of a file: what it is, and how its numbers become SI.
struct Column {
  const Known* known = nullptr;
  units::Conversion conversion;
};

/// Reads a heading such as "diameter [mm]".
Column column_of(const std::string& heading) {
  const std::size_t bracket = heading.find(" [");
  const std::string name = heading.substr(0, bracket);
  const std::vector<Known>& all = known_columns();
  const auto found = std::ranges::find(all, name, &Known::name);
  if (found == all.end()) {
    std::vector<std::string> names;
    for (const Known& known : all) names.emplace_back(known.name);
    throw InputError(fmt::format("unknown column \"{}\"{} (accepted: {})", heading, did_you_mean(name, names),
                                 columns_of_shots()));
  }
  if (found->unit.empty() != (bracket == std::string::npos) ||
      (!found->unit.empty() && heading.back() != ']'))
    throw InputError(found->unit.empty() ? fmt::format("column \"{}\" is a text without a unit", heading)
                                         : fmt::format("column \"{}\" needs a unit, as in \"{} [{}]\"",
                                                       heading, name, found->unit));
  if (found->unit.empty()) return {&*found, {}};
  const std::string unit = heading.substr(bracket + 2, heading.size() - bracket - 3);
  return {&*found, units::conversion(unit, found->unit)};
}

double number_of(const std::string& cell, const Column& column) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (fault != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    throw InputError(fmt::format("{} is \"{}\", expected a finite number", column.known->name, cell));
  value = column.conversion.factor * value + column.conversion.offset;
  if (!column.known->range.contains(value))
    throw InputError(
        fmt::format("{} is {}, expected {}", column.known->name, cell, column.known->range.text()));
  return value;
}

/// Runs `read` and adds what it reports to the faults of a line.
template <class Read>
void collect(std::vector<InputFault>& faults, const std::filesystem::path& file, unsigned line,
             const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    faults.push_back({.file = file.string(), .line = line, .column = 1, .text = error.what()});
  }
}

std::vector<Column> read_heading(const std::vector<std::string>& cells, std::vector<InputFault>& faults,
                                 const std::filesystem::path& file, unsigned line) {
  std::vector<Column> columns;
  for (const std::string& cell : cells) {
    collect(faults, file, line, [&] {
      const Column column = column_of(cell);
      if (std::ranges::count(columns, column.known, &Column::known) > 0)
        throw InputError(fmt::format("column \"{}\" occurs twice", cell));
      columns.push_back(column);
    });
  }
  for (const Known& known : known_columns()) {
    if (known.need == Need::optional || std::ranges::count(columns, &known, &Column::known) > 0) continue;
    faults.push_back(
        {.file = file.string(),
         .line = line,
         .column = 1,
         .text = fmt::format("column \"{}\" is missing (accepted: {})", known.name, columns_of_shots())});
  }
  return columns;
}

}  // namespace

std::string columns_of_shots() {
  std::string text;
  for (const Known& known : known_columns()) {
    text += text.empty() ? "" : ", ";
    text += known.name;
    if (!known.unit.empty()) text += fmt::format(" [{}]", known.unit);
  }
  return text;
}

std::vector<Shot> read_shots(const std::filesystem::path& file) {
  std::istringstream lines(read_text(file));
  std::vector<InputFault> faults;
  std::vector<Column> columns;
  std::vector<Shot> shots;
  std::string line;
  for (unsigned number = 1; std::getline(lines, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> cells = csv_cells(line);
    if (columns.empty()) {
      columns = read_heading(cells, faults, file, number);
      if (!faults.empty()) throw InputError(std::move(faults));
      continue;
    }
    Shot shot;
    shot.impact.shield.bumpers.emplace_back();
    if (cells.size() != columns.size()) {
      faults.push_back({.file = file.string(),
                        .line = number,
                        .column = 1,
                        .text = fmt::format("{} cells, the heading has {}", cells.size(), columns.size())});
      continue;
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const Column& column = columns[k];
      if (cells[k].empty() && column.known->need == Need::optional) continue;
      collect(faults, file, number, [&] {
        if (column.known->text) {
          column.known->text(shot, cells[k]);
        } else {
          column.known->number(shot, number_of(cells[k], column));
        }
      });
    }
    if (faults.empty()) complete(shot.impact);
    shots.push_back(std::move(shot));
  }
  if (columns.empty())
    throw InputError(
        fmt::format("{}: error: no heading (accepted columns: {})", file.string(), columns_of_shots()));
  if (!faults.empty()) throw InputError(std::move(faults));
  if (shots.empty()) throw InputError(fmt::format("{}: error: has a heading but no shots", file.string()));
  return shots;
}

}  // namespace whipple::shields

// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/point_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"
#include "src/solids/fields.hpp"

namespace whipple::solids {
namespace {

constexpr std::array<std::string_view, 5> known = {"x", "y", "z", "mass", "volume"};
constexpr double not_given = std::numeric_limits<double>::infinity();

struct Heading {
  std::string name, unit;
};

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool is_known(std::string_view name) { return std::ranges::find(known, name) != known.end(); }

const char* si_unit_of(std::string_view name) {
  return name == "mass" ? "kg" : name == "volume" ? "m^3" : "m";
}

bool fits(const std::string& unit, const char* si_unit) {
  try {
    units::conversion(unit, si_unit);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Splits "x [mm]" and "x_mm" into name and unit.
Heading heading_of(std::string_view text) {
  text = without_blanks(text);
  const std::size_t bracket = text.find('[');
  if (bracket != std::string_view::npos && text.ends_with(']')) {
    return {lower_case(without_blanks(text.substr(0, bracket))),
            std::string(without_blanks(text.substr(bracket + 1, text.size() - bracket - 2)))};
  }
  const std::size_t bar = text.find('_');
  const std::string name = lower_case(text.substr(0, bar));
  if (bar != std::string_view::npos && is_known(name)) {
    const std::string unit(text.substr(bar + 1));
    if (fits(unit, si_unit_of(name))) return {name, unit};  // not "mass_fraction"
  }
  return {lower_case(text), ""};
}

/// Finds the columns of a table and converts their values to SI.
class Taker {
 public:
  Taker(const PointTable& table, const PointUnits& units) : table_(table), units_(units) {}

  [[nodiscard]] const PointTable::Column* find(std::string_view name) const {
    const PointTable::Column* found = nullptr;
    for (const PointTable::Column& column : table_.columns) {
      if (heading_of(column.heading).name != name) continue;
      if (found != nullptr) fail(fmt::format("has two columns '{}'", name));
      found = &column;
    }
    return found;
  }

  /// Returns the values of a column in m, m^3 or kg.
  [[nodiscard]] std::vector<double> in_si(const PointTable::Column& column, int lengths) const {
    const double factor = factor_of(column, lengths);
    std::vector<double> values = column.values;
    for (double& value : values) value *= factor;
    return values;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", table_.file, what));
  }

 private:
  /// @param lengths  power of the length in the unit; 0: a mass
  [[nodiscard]] double factor_of(const PointTable::Column& column, int lengths) const {
    const Heading heading = heading_of(column.heading);
    const bool is_mass = lengths == 0;
    const double given = is_mass ? units_.mass : std::pow(units_.length, lengths);
    const char* const key = is_mass ? "mass_unit" : "unit";
    if (heading.unit.empty()) {
      if (given != not_given) return given;
      fail(fmt::format("the column '{}' has no unit: write it as '{} [{}]', or give '{}'", heading.name,
                       heading.name,
                       is_mass        ? "g"
                       : lengths == 3 ? "mm^3"
                                      : "mm",
                       key));
    }
    double own = 0.0;
    try {
      own = units::conversion(heading.unit, si_unit_of(heading.name)).factor;
    } catch (const InputError& error) {
      fail(fmt::format("the column '{}': {}", shown(column.heading), error.what()));
    }
    if (given != not_given && std::abs(own - given) > 1e-9 * given) {
      fail(fmt::format("the column '{}' is in {}, and '{}' says otherwise", heading.name, heading.unit, key));
    }
    return own;
  }

  const PointTable& table_;
  const PointUnits& units_;
};

std::vector<std::string> headings_of(const PointTable& table) {
  std::vector<std::string> names;
  for (const PointTable::Column& column : table.columns) names.push_back(shown(column.heading));
  return names;
}

void require_sound(const PointList& points) {
  for (std::size_t i = 0; i < points.places.size(); ++i) {
    if (!points.places[i].allFinite()) {
      throw InputError(fmt::format("{}: a coordinate that is not finite", points.where(i)));
    }
    if (!std::isfinite(points.amounts[i]) || !(points.amounts[i] > 0.0)) {
      throw InputError(fmt::format("{}: a {} of {}: expected > 0", points.where(i),
                                   points.are_masses ? "mass" : "volume", points.amounts[i]));
    }
  }
  std::vector<std::size_t> order(points.places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) {
    const Vector3& x = points.places[i];
    return std::tuple(x[0], x[1], x[2]);
  };
  std::ranges::stable_sort(order, {}, place);
  const auto twin = std::ranges::adjacent_find(order, {}, place);
  if (twin == order.end()) return;
  throw InputError(fmt::format(
      "{}: a second particle at the place of that of {}", points.where(*std::next(twin)),
      points.lines.empty() ? fmt::format("point {}", *twin) : fmt::format("line {}", points.lines[*twin])));
}

}  // namespace

std::string PointList::where(std::size_t i) const {
  return lines.empty() ? fmt::format("{}: point {}", file, i) : fmt::format("{}:{}", file, lines[i]);
}

bool is_size_column(std::string_view heading) {
  const std::string name = heading_of(heading).name;
  return name == "mass" || name == "volume";
}

PointTable read_point_csv(std::string_view bytes, const std::string& file) {
  PointTable table;
  table.file = file;
  if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty", file));
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // mark of UTF-8
  std::vector<std::optional<std::size_t>> column_of;              // of each cell of a row; nothing: not read
  Fields fields(bytes, file);
  while (fields.next_line()) {
    const std::string_view line = without_blanks(fields.rest());
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string> cells = csv_cells(line);
    if (column_of.empty()) {
      for (const std::string& cell : cells) {
        const bool is_taken = is_known(heading_of(cell).name);
        column_of.push_back(is_taken ? std::optional(table.columns.size()) : std::nullopt);
        if (is_taken) {
          table.columns.push_back({cell, {}});
        } else {
          table.unread.push_back(shown(cell));
        }
      }
      if (table.columns.empty()) {
        fields.fail(
            fmt::format("\"{}\" is no heading: expected columns x, y, z, and mass or volume, such as "
                        "\"x [mm],y [mm],z [mm],mass [g]\"",
                        shown(line)));
      }
      continue;
    }
    if (cells.size() != column_of.size()) {
      fields.fail(fmt::format("{} cells, the heading has {}", cells.size(), column_of.size()));
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (!column_of[k]) continue;
      PointTable::Column& column = table.columns[*column_of[k]];
      const std::optional<double> value = Fields::parsed<double>(without_blanks(cells[k]));
      if (!value) {
        fields.fail(fmt::format("column '{}': expected a number instead of \"{}\"",
                                heading_of(column.heading).name, shown(cells[k])));
      }
      column.values.push_back(*value);
    }
    table.lines.push_back(fields.line_number());
  }
  if (column_of.empty()) throw InputError(fmt::format("{}: has no heading, only remarks", file));
  if (table.lines.empty()) throw InputError(fmt::format("{}: has a heading, but no particles", file));
  return table;
}

PointList points_of(const PointTable& table, const PointUnits& units, SizeColumn size) {
  const Taker taker(table, units);
  const auto require = [&](std::string_view name) {
    const PointTable::Column* column = taker.find(name);
    if (column != nullptr) return column;
    taker.fail(fmt::format("has no column '{}', only: {}", name, fmt::join(headings_of(table), ", ")));
  };
  PointList points;
  points.file = table.file;
  points.lines = table.lines;
  const PointTable::Column* mass = size == SizeColumn::volume ? nullptr : taker.find("mass");
  const PointTable::Column* volume = size == SizeColumn::mass ? nullptr : taker.find("volume");
  if (mass != nullptr && volume != nullptr)
    taker.fail("has both 'mass' and 'volume': 'size' says which counts");
  if (mass == nullptr && volume == nullptr) {
    const char* const wanted = size == SizeColumn::mass     ? "'mass'"
                               : size == SizeColumn::volume ? "'volume'"
                                                            : "'mass' or 'volume'";
    taker.fail(fmt::format("has no column {}, only: {}", wanted, fmt::join(headings_of(table), ", ")));
  }
  points.are_masses = mass != nullptr;
  points.amounts = points.are_masses ? taker.in_si(*mass, 0) : taker.in_si(*volume, 3);
  if (points.amounts.empty()) taker.fail("has no particles");
  points.places.assign(points.amounts.size(), Vector3::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view name = known[static_cast<std::size_t>(axis)];
    const PointTable::Column* column = axis == 2 ? taker.find(name) : require(name);
    if (column == nullptr) continue;
    const std::vector<double> values = taker.in_si(*column, 1);
    for (std::size_t i = 0; i < values.size(); ++i) points.places[i][axis] = values[i];
  }
  require_sound(points);
  return points;
}

}  // namespace whipple::solids

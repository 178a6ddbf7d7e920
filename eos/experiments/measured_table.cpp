// SPDX-License-Identifier: BSD-3-Clause
#include "eos/experiments/measured_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/pattern.hpp"
#include "src/core/base/units.hpp"

namespace whipple::eos::experiments {
namespace {

/// Holds a quantity with the words that name it, the best first, without the characters removed by `plain`.
/// Spellings of one letter are valid only with a matching unit: D is a shock velocity in km/s and a diameter in mm.
struct Spelling {
  Quantity quantity;
  std::string_view si_unit;
  std::array<std::string_view, 6> words;
};
constexpr std::array spellings = {
    Spelling{Quantity::shock_velocity, "m/s", {"us", "shockvelocity", "shockspeed", "d"}},
    Spelling{Quantity::particle_velocity, "m/s", {"up", "particlevelocity", "particlespeed", "u"}},
    Spelling{Quantity::pressure, "Pa", {"p", "pressure", "previsedruby", "previsedscale", "prevised"}},
    Spelling{Quantity::specific_volume, "m^3/kg", {"v", "specificvolume"}},
    Spelling{Quantity::atomic_volume, "m^3", {"atomicvolume", "v"}},
    Spelling{Quantity::density, "kg/m^3", {"rho", "density", "r", "\u03c1"}},
    Spelling{Quantity::volume_ratio, "", {"voverv0", "v/v0"}},
    Spelling{Quantity::temperature, "K", {"tm", "t", "temperature", "meltingtemperature"}},
    Spelling{Quantity::initial_density,
             "kg/m^3",
             {"rho00", "r00", "rho0", "initialdensity", "density0", "\u03c10"}},
    Spelling{Quantity::porosity, "", {"m", "porosity", "distension"}},
    Spelling{Quantity::hugoniot_intercept, "m/s", {"c", "c0"}},
    Spelling{Quantity::hugoniot_slope, "", {"s", "s1"}},
    Spelling{Quantity::hugoniot_quadratic, "", {"s2"}},
    Spelling{Quantity::hugoniot_cubic, "", {"s3"}},
    Spelling{Quantity::bulk_sound_speed,
             "m/s",
             {"cb", "cbulk", "bulksoundspeed", "bulksoundvelocity", "soundspeed"}},
    Spelling{Quantity::heat_capacity, "J/(kg K)", {"cp", "heatcapacity", "specificheat"}},
    Spelling{Quantity::linear_expansion, "1/K", {"alphalin", "linearexpansion", "alphal"}},
};

/// Returns the entry of a quantity above.
const Spelling& spelling_of(Quantity quantity) {
  return *std::ranges::find(spellings, quantity, &Spelling::quantity);
}

constexpr std::size_t other_scale = 100;  // rank of a pressure scale other than the revised one

/// Reduces a spelling: "U_p", "u p" and "$u_{p}$" are "up".
std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("_ -{}$\\").find(c) == std::string_view::npos) {
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return result;
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t\r") + 1 - first));
}

/// Normalises a unit: "A3" and "A^3" are cubic angstroms, in atomic volumes, not cubic amperes; "1e-6/K", in headings
/// also "1e-6_per_K", is the usual unit of thermal expansion; "J/kgK" that of heat capacities.
std::string unit_text(std::string_view text) {
  std::string unit = trimmed(text);
  if (unit == "-") return "";
  for (const char* cube : {"A3", "A^3", "\u00c53", "\u00c5^3"}) {
    if (unit == cube) return "angstrom^3";
  }
  for (const char* millionth : {"1e-6/K", "1e-6/per/K", "10^-6/K", "1e-6 1/K", "1e-6 K^-1", "ppm/K"}) {
    if (unit == millionth) return "1/MK";
  }
  for (const char* specific : {"J/kgK", "J/kg/K", "J/(kg*K)"}) {
    if (unit == specific) return "J/(kg K)";
  }
  return unit;
}

bool fits(std::string_view unit, std::string_view si_unit) {
  try {
    units::conversion(unit, si_unit);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Returns whether a cell is a number, and its value; empty cells and "nan" are NaN.
bool read_number(std::string_view cell, double& value) {
  value = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty() || cell == "-") return true;
  if (cell.front() == '+') cell.remove_prefix(1);
  const auto [rest, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return status == std::errc() && rest == cell.data() + cell.size();
}

constexpr std::string_view percent = "%";

/// Returns a heading without the unit at its end: "D" of "D [mm]" and "D_mm".
std::string without_unit(const std::string& heading) {
  const std::size_t bracket = heading.find_first_of("[(");
  if (bracket != std::string::npos) return trimmed(heading.substr(0, bracket));
  for (std::size_t at = heading.rfind('_'); at != std::string::npos && at > 0;
       at = heading.rfind('_', at - 1)) {
    std::string unit = heading.substr(at + 1);
    std::ranges::replace(unit, '_', '/');
    if (!unit.empty() && fits(unit, unit)) return heading.substr(0, at);
  }
  return heading;
}

/// Returns the quantity to whose error a heading refers: "us" of "us_err", "sigma_us" and "dus", both reduced by
/// `plain`. Empty if it is not an error.
std::string_view subject_of_error(std::string_view heading) {
  for (const std::string_view end : {"err", "error", "uncertainty", "unc", "sigma", "std", "sd"}) {
    if (heading.size() > end.size() && heading.ends_with(end))
      return heading.substr(0, heading.size() - end.size());
  }
  for (const std::string_view start : {"sigma", "error", "err", "delta", "\u03c3", "\u03b4", "\u0394", "d"}) {
    if (heading.size() > start.size() && heading.starts_with(start)) return heading.substr(start.size());
  }
  return "";
}

char separator_of(const std::string& headings) {
  for (const char separator : {';', '\t', ','}) {
    if (headings.find(separator) != std::string::npos) return separator;
  }
  return ' ';
}

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> cells(1);
  bool inside_quotes = false;
  int brackets = 0;  // "up (km/s)" is one heading in blank-separated text
  for (const char c : line) {
    if (c == '"') {
      inside_quotes = !inside_quotes;
      continue;
    }
    brackets += c == '[' || c == '(' ? 1 : c == ']' || c == ')' ? -1 : 0;
    const bool ends = separator == ' ' ? c == ' ' && brackets == 0 : c == separator;
    if (!ends || inside_quotes) {
      cells.back() += c;
    } else if (separator != ' ' || !cells.back().empty()) {
      cells.emplace_back();
    }
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  if (separator == ' ' && cells.back().empty()) cells.pop_back();
  return cells;
}

/// Reads numbers with a decimal comma, "8,93" and "1,2e-3", in tables whose cells are not separated by commas.
void take_decimal_commas(std::vector<std::string>& cells) {
  static const Pattern number("^[-+]?[0-9]*,[0-9]+([eE][-+]?[0-9]+)?$");
  for (std::string& cell : cells) {
    if (number.is_in(cell)) cell.replace(cell.find(','), 1, ".");
  }
}

/// Joins a separate unit in brackets to the preceding heading: "up [km/s]" in blank-separated text.
void join_units(std::vector<std::string>& headings) {
  for (std::size_t i = headings.size(); i-- > 1;) {
    if (!headings[i].starts_with('[') && !headings[i].starts_with('(')) continue;
    headings[i - 1] += " " + headings[i];
    headings.erase(headings.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

MeasuredTable MeasuredTable::read(const std::filesystem::path& file) {
  std::istringstream stream(read_text(file));
  MeasuredTable table;
  table.file_ = file;
  char separator = ' ';
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    if (++number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    const auto fail = [&](const std::string& what) {
      throw InputError(fmt::format("{}:{}: {}", file.string(), number, what));
    };
    if (line.find('\0') != std::string::npos) fail("not a text in UTF-8: it holds a zero byte (UTF-16?)");
    line = trimmed(line);
    if (line.find_first_not_of(";,") == std::string::npos) continue;  // no cells
    if (line.front() == '#' || line.front() == '%') {
      table.comments_.push_back(trimmed(line.substr(line.find_first_of("#%") + 1)));
      continue;
    }
    if (table.columns_.empty()) {
      separator = separator_of(line);
      std::vector<std::string> headings = split(line, separator);
      if (separator == ' ') join_units(headings);
      for (const std::string& heading : headings) {
        table.columns_.push_back(table.understand(heading, number));
      }
      continue;
    }
    std::vector<std::string> cells = split(line, separator);
    if (cells.size() != table.columns_.size()) {
      fail(fmt::format("{} cells, the header has {}{}", cells.size(), table.columns_.size(),
                       separator == ',' && cells.size() > table.columns_.size()
                           ? " (a decimal comma? Numbers are written with a point)"
                           : ""));
    }
    if (separator != ',') take_decimal_commas(cells);
    if (table.cells_.empty() && table.take_units(cells)) continue;
    table.cells_.push_back(std::move(cells));
    table.lines_.push_back(number);
  }
  if (table.cells_.empty()) throw InputError(fmt::format("{}: no rows of data", file.string()));
  table.assign_errors();
  return table;
}

MeasuredTable::Column MeasuredTable::understand(const std::string& heading, int line) const {
  struct Spelt {
    std::size_t spelling;
    bool is_error;
  };
  const auto spelt = [](std::string_view text, const Spelling& known) -> std::optional<Spelt> {
    const auto place = [&](std::string_view bare) -> std::optional<std::size_t> {
      const auto found = std::ranges::find(known.words, bare);
      if (bare.empty() || found == known.words.end()) return std::nullopt;
      return static_cast<std::size_t>(found - known.words.begin());
    };
    const std::string bare = plain(text);
    if (const auto found = place(bare)) return Spelt{*found, false};
    const std::string_view subject = subject_of_error(bare);
    if (const auto found = place(subject)) return Spelt{*found, true};
    const bool scale =
        known.quantity == Quantity::pressure && (text.starts_with("P_") || text.starts_with("p_"));
    if (scale) return Spelt{other_scale, !subject.empty()};
    return std::nullopt;
  };
  const auto fits_column = [](std::string_view unit, const Spelling& known, const Spelt& found) {
    return fits(unit, known.si_unit) || (found.is_error && unit == percent);
  };
  const auto column = [&](const Spelling& known, const Spelt& found, std::string_view name,
                          std::optional<std::string> unit) {
    Column made{heading, known.quantity, found.spelling, found.is_error, std::move(unit)};
    const std::string bare = plain(name);
    made.word = found.is_error ? std::string(subject_of_error(bare)) : bare;
    for (const Spelling& other : spellings) {
      const auto same = spelt(name, other);
      if (same && same->is_error == found.is_error && (!made.unit || fits_column(*made.unit, other, *same)))
        made.could_be.push_back(other.quantity);
    }
    return made;
  };
  const Column unknown{heading, std::nullopt, 0, false, std::nullopt, plain(without_unit(heading))};
  const std::size_t bracket = heading.find_first_of("[(");
  if (bracket != std::string::npos && (heading.back() == ']' || heading.back() == ')')) {
    const std::string name = trimmed(heading.substr(0, bracket));
    const std::string unit = unit_text(heading.substr(bracket + 1, heading.size() - bracket - 2));
    for (const Spelling& known : spellings) {
      const auto found = spelt(name, known);
      if (!found) continue;
      if (fits_column(unit, known, *found)) return column(known, *found, name, unit);
      if (plain(name).size() > 1 && !found->is_error) {
        throw InputError(fmt::format("{}:{}: column '{}': '{}' is no unit of the kind '{}'", file_.string(),
                                     line, heading, unit, known.si_unit));
      }
    }
    return unknown;
  }
  for (const Spelling& known : spellings) {
    const auto found = spelt(heading, known);
    if (found && found->spelling != other_scale)
      return column(known, *found, heading,
                    known.si_unit.empty() ? std::optional<std::string>("") : std::nullopt);
  }
  // "up_km_s": use the shortest ending that is a unit, so that P_revised_ruby_GPa gives P_revised_ruby.
  for (const Spelling& known : spellings) {
    for (std::size_t at = heading.rfind('_'); at != std::string::npos && at > 0;
         at = heading.rfind('_', at - 1)) {
      std::string unit = heading.substr(at + 1);
      std::ranges::replace(unit, '_', '/');
      unit = unit_text(unit);
      const std::string name = heading.substr(0, at);
      const auto found = spelt(name, known);
      const bool needs_one = !known.si_unit.empty() || (found && found->is_error);
      if (found && !unit.empty() && needs_one && fits_column(unit, known, *found))
        return column(known, *found, name, unit);
    }
  }
  return unknown;
}

bool MeasuredTable::take_units(const std::vector<std::string>& cells) {
  double number = 0.0;
  std::vector<Column> with_units = columns_;
  bool any = false;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::string unit = cells[i];
    std::erase_if(unit, [](char c) { return std::string_view("[]()").find(c) != std::string_view::npos; });
    if (unit.empty()) continue;
    if (read_number(unit, number) && unit != "-") return false;
    Column& column = with_units[i];
    if (!column.quantity) continue;
    column.unit = unit_text(unit);
    if (!column.is_error || unit != percent) {
      std::erase_if(column.could_be,
                    [&](Quantity quantity) { return !fits(*column.unit, spelling_of(quantity).si_unit); });
      if (column.could_be.empty() && column.word.size() > 1) return false;
      column.quantity = column.could_be.empty() ? std::nullopt : std::optional(column.could_be.front());
    }
    any = true;
  }
  columns_ = std::move(with_units);
  return any;
}

std::optional<Quantity> MeasuredTable::quantity_of(const std::string& heading) {
  const Column column = MeasuredTable().understand(heading, 0);
  return column.is_error ? std::nullopt : column.quantity;
}

std::string MeasuredTable::headings() const {
  std::string text;
  for (const Column& column : columns_) text += (text.empty() ? "" : ", ") + column.heading;
  return text;
}

std::optional<std::size_t> MeasuredTable::find(Quantity quantity) const {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].quantity != quantity || columns_[i].is_error) continue;
    if (!best || columns_[i].spelling < columns_[*best].spelling) best = i;
  }
  return best;
}

std::optional<std::size_t> MeasuredTable::find_heading(std::string_view heading) const {
  const auto found = std::ranges::find(columns_, heading, &Column::heading);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::vector<double> MeasuredTable::numbers(std::size_t index) const {
  const Column& column = columns_[index];
  units::Conversion conversion;
  if (column.quantity) {
    const Spelling& known = spelling_of(*column.quantity);
    if (!column.unit) {
      throw InputError(
          fmt::format("{}: column '{}' gives no unit: write \"{} [{}]\", with the unit of the file",
                      file_.string(), column.heading, column.heading, known.si_unit));
    }
    if (*column.unit == percent) {
      conversion.factor = 0.01;  // of the quantity, see errors()
    } else {
      conversion = units::conversion(*column.unit, known.si_unit);
    }
    if (column.is_error) conversion.offset = 0.0;  // an error of 5 degC is 5 K
  }
  std::vector<double> values(rows());
  for (std::size_t row = 0; row < rows(); ++row) {
    const std::string& cell = cells_[row][index];
    if (!read_number(cell, values[row])) {
      throw InputError(fmt::format(
          "{}:{}: '{}' in column {} is not a number{}", file_.string(), lines_[row], cell, column.heading,
          cell.find(',') == std::string::npos ? "" : ": a decimal comma? Numbers are written with a point"));
    }
    values[row] = conversion.factor * values[row] + conversion.offset;
  }
  return values;
}

std::vector<double> MeasuredTable::numbers(Quantity quantity) const {
  const auto column = find(quantity);
  return column ? numbers(*column) : std::vector<double>();
}

void MeasuredTable::assign_errors() {
  for (Column& error : columns_) {
    if (!error.is_error) continue;
    const auto has = [&](std::optional<Quantity> quantity, bool of_this_word) {
      return std::ranges::any_of(columns_, [&](const Column& column) {
        return column.quantity == quantity && !column.is_error &&
               (!of_this_word || column.word == error.word);
      });
    };
    const auto take = [&](bool of_this_word) {
      const auto present = std::ranges::find_if(
          error.could_be, [&](Quantity quantity) { return has(quantity, of_this_word); });
      if (present == error.could_be.end()) return false;
      error.quantity = *present;
      return true;
    };
    if (take(true)) continue;
    if (has(std::nullopt, true)) {
      error.quantity.reset();
    } else {
      take(false);
    }
  }
}

std::optional<std::size_t> MeasuredTable::find_errors(Quantity quantity) const {
  const auto whole = find(quantity);
  if (!whole) return std::nullopt;
  std::optional<std::size_t> of_no_other;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& error = columns_[i];
    if (error.quantity != quantity || !error.is_error) continue;
    if (error.word == columns_[*whole].word) return i;
    const bool of_another = std::ranges::any_of(columns_, [&](const Column& column) {
      return column.quantity == quantity && !column.is_error && column.word == error.word;
    });
    if (!of_another && !of_no_other) of_no_other = i;
  }
  return of_no_other;
}

std::vector<double> MeasuredTable::errors(Quantity quantity) const {
  const auto column = find_errors(quantity);
  if (!column) return {};
  std::vector<double> values = numbers(*column);
  if (columns_[*column].unit != percent) return values;
  const std::vector<double> whole = numbers(quantity);
  for (std::size_t row = 0; row < values.size(); ++row) values[row] *= std::abs(whole[row]);
  return values;
}

std::vector<std::string> MeasuredTable::unused_errors() const {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    const std::string bare = plain(column.heading);
    const bool unknown =
        !column.quantity &&
        std::ranges::any_of(std::array{"err", "sigma", "uncert", "\u00b1"},
                            [&](const char* word) { return bare.find(word) != std::string::npos; });
    const bool used = column.is_error && column.quantity && find_errors(*column.quantity) == i;
    if (unknown || (column.is_error && !used)) found.push_back(column.heading);
  }
  return found;
}

std::vector<std::string> MeasuredTable::texts(std::size_t column) const {
  std::vector<std::string> values;
  for (const auto& row : cells_) values.push_back(row[column]);
  return values;
}

}  // namespace whipple::eos::experiments

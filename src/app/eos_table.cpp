// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "src/core/base/csv.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/text_table.hpp"

namespace whipple::app {
namespace {

using eos::curves::Cell;
using eos::curves::Column;
using eos::curves::CurveRow;
using eos::curves::CurveTable;
using eos::curves::Series;
using Lines = std::vector<std::vector<std::string>>;

bool known(const Cell& cell) {
  const double* number = std::get_if<double>(&cell);
  return number == nullptr || !std::isnan(*number);
}

std::string text(const Cell& cell, double size, int digits) {
  if (const auto* word = std::get_if<std::string>(&cell)) return *word;
  const double value = std::get<double>(cell) / size;
  return std::isnan(value) ? "-" : fmt::format("{:.{}g}", value, digits);
}

/// Formats a cell. Round-off near zero (the pressure of a state at rest) is printed as 0; the CSV keeps every digit.
std::string printed(const Cell& cell, double size, double greatest) {
  const double* number = std::get_if<double>(&cell);
  const bool nothing = number != nullptr && std::abs(*number) < std::max(1e-11 * greatest, 1e-12 * size);
  return nothing ? "0" : text(cell, size, 6);
}

/// Returns the maximum magnitude of the numbers of a column; negative if no value is known.
double greatest(const CurveTable& table, std::size_t column) {
  double result = -1;
  for (const Series& series : table.series) {
    for (const CurveRow& row : series.rows) {
      if (!known(row[column])) continue;
      const double* number = std::get_if<double>(&row[column]);
      const bool finite = number != nullptr && std::isfinite(*number);
      result = std::max(result, finite ? std::abs(*number) : 0.0);
    }
  }
  return result;
}

}  // namespace

void print(const CurveTable& table) {
  fmt::print("{}\n", table.title);
  const bool several = table.series.size() > 1;
  Lines lines(2);
  if (several) lines = {{"material"}, {""}};
  std::vector<std::size_t> shown;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    sizes.push_back(greatest(table, i));
    if (!column.in_curves || sizes.back() < 0) continue;
    shown.push_back(i);
    // "P_GPa" is printed as P above GPa; a name without a unit is printed alone.
    lines[0].push_back(
        column.name.substr(0, column.unit.empty() ? column.name.size() : column.name.find('_')));
    lines[1].push_back(column.unit);
  }
  for (const Series& series : table.series) {
    for (const CurveRow& row : series.rows) {
      lines.emplace_back();
      if (several) lines.back().push_back(series.name);
      for (const std::size_t i : shown)
        lines.back().push_back(printed(row[i], table.columns[i].size, sizes[i]));
    }
  }
  fmt::print("{}", text_table(lines, several ? "lr" : "r"));
}

void print_list(const CurveTable& table) {
  fmt::print("{}\n", table.title);
  Lines lines;
  if (table.series.size() > 1) {
    lines.push_back({""});
    for (const Series& series : table.series) lines.back().push_back(series.name);
  }
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    const double size = greatest(table, i);
    if (size < 0) continue;
    lines.push_back({column.meaning.empty() ? column.name : column.meaning});
    for (const Series& series : table.series) {
      lines.back().push_back(printed(series.rows.front()[i], column.size, size));
    }
    lines.back().push_back(column.unit);
  }
  fmt::print("{}", text_table(lines, "l" + std::string(table.series.size(), 'r') + "l"));
}

std::string csv_text(const CurveTable& table) {
  std::ostringstream file;
  const bool several = table.series.size() > 1;
  file << "# " << table.title << '\n' << (several ? "material," : "");
  for (std::size_t i = 0; i < table.columns.size(); ++i) file << (i > 0 ? "," : "") << table.columns[i].name;
  file << '\n';
  for (const Series& series : table.series) {
    for (const CurveRow& row : series.rows) {
      if (several) file << csv_cell(series.name) << ',';
      for (std::size_t i = 0; i < row.size(); ++i) {
        file << (i > 0 ? "," : "")
             << (known(row[i]) ? csv_cell(text(row[i], table.columns[i].size, 10)) : "");
      }
      file << '\n';
    }
  }
  return file.str();
}

std::string table_as_json(const CurveTable& table) {
  nlohmann::ordered_json all = {{"title", table.title}, {"materials", nlohmann::json::array()}};
  for (const Series& series : table.series) {
    nlohmann::ordered_json rows = nlohmann::json::array();
    for (const CurveRow& row : series.rows) {
      nlohmann::ordered_json cells;
      for (std::size_t i = 0; i < row.size(); ++i) {
        nlohmann::ordered_json& cell = cells[table.columns[i].name];
        if (!known(row[i])) continue;  // null
        if (const double* number = std::get_if<double>(&row[i])) {
          cell = *number / table.columns[i].size;
        } else {
          cell = std::get<std::string>(row[i]);
        }
      }
      rows.push_back(std::move(cells));
    }
    all["materials"].push_back({{"material", series.name}, {"end", series.end}, {"rows", std::move(rows)}});
  }
  return json_text(all, 1) + "\n";
}

bool is_standard_output(const std::string& name) {
  constexpr std::string_view dash = "-";
  return name == dash;
}

void write_output(const std::string& name, const std::string& text) {
  if (name.empty()) return;
  if (is_standard_output(name)) {
    fmt::print("{}", text);
    return;
  }
  write_text_atomically(name, text);
  fmt::print("written: {}\n", name);
}

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "src/base/error.hpp"
#include "src/base/files.hpp"
#include "src/base/text_table.hpp"
#include "src/process/scripts.hpp"

namespace whipple::app {
namespace {

bool known(const Cell& cell) {
  const double* number = std::get_if<double>(&cell);
  return number == nullptr || !std::isnan(*number);
}

std::string text(const Cell& cell, double size, int digits) {
  if (const auto* word = std::get_if<std::string>(&cell)) return *word;
  const double value = std::get<double>(cell) / size;
  return std::isnan(value) ? "-" : fmt::format("{:.{}g}", value, digits);
}

void write_csv(const CurveTable& table, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << "# " << table.title << '\n';
  for (std::size_t i = 0; i < table.columns.size(); ++i) file << (i > 0 ? "," : "") << table.columns[i].name;
  file << '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      file << (i > 0 ? "," : "") << (known(row[i]) ? text(row[i], table.columns[i].size, 10) : "");
    }
    file << '\n';
  }
  if (!file.flush()) throw InputError(fmt::format("cannot write '{}'", path.string()));
}

}  // namespace

std::vector<Column> state_columns() {
  return {{"rho_kg_m3", "kg/m^3", 1},
          {"V_over_V0", "", 1},
          {"P_GPa", "GPa", 1e9},
          {"T_K", "K", 1},
          {"e_kJ_kg", "kJ/kg", 1e3},
          {"c_km_s", "km/s", 1e3},
          {"s_J_kg_K", "J/(kg K)", 1},
          {"cv_J_kg_K", "J/(kg K)", 1},
          {"gamma", "", 1},
          {"KT_GPa", "GPa", 1e9},
          {"melted", "", 1},
          {"vaporised", "", 1},
          {"phase", "", 1}};
}

std::vector<Cell> state_cells(const eos::State& s, const eos::EquationOfState& eos) {
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
          s.melted_fraction,
          s.vaporised_fraction,
          std::string(s.phase)};
}

void print(const CurveTable& table) {
  fmt::print("{}\n", table.title);
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (std::ranges::any_of(table.rows, [&](const auto& row) { return known(row[i]); })) shown.push_back(i);
  }
  std::vector<std::vector<std::string>> lines(2);
  for (const std::size_t i : shown) {
    const Column& column = table.columns[i];
    // "P_GPa" prints as P over GPa; a name without unit stands alone.
    const std::size_t end = column.unit.empty() ? column.name.size() : column.name.find('_');
    lines[0].push_back(column.name.substr(0, end));
    lines[1].push_back(column.unit);
  }
  // Round-off about zero (the pressure of a state at rest) prints as 0; the CSV keeps every digit.
  std::vector<double> greatest(table.columns.size(), 0.0);
  for (const auto& row : table.rows) {
    for (const std::size_t i : shown) {
      const double* number = std::get_if<double>(&row[i]);
      if (number != nullptr && std::isfinite(*number)) greatest[i] = std::max(greatest[i], std::abs(*number));
    }
  }
  for (const auto& row : table.rows) {
    lines.emplace_back();
    for (const std::size_t i : shown) {
      const double* number = std::get_if<double>(&row[i]);
      const double size = table.columns[i].size;
      const bool nothing =
          number != nullptr && std::abs(*number) < std::max(1e-11 * greatest[i], 1e-12 * size);
      lines.back().push_back(nothing ? "0" : text(row[i], table.columns[i].size, 6));
    }
  }
  fmt::print("{}", text_table(lines, "r"));
}

void require_writable(const CurveOutput& output) {
  require_new_file(output.csv, output.force);
  require_new_figure(output.plot, output.force);
}

void write(const CurveTable& table, const CurveOutput& output) {
  print(table);
  if (!output.csv.empty()) {
    write_csv(table, output.csv);
    fmt::print("written: {}\n", output.csv);
  }
  if (output.plot.empty()) return;
  const std::filesystem::path data = output.plot + ".csv.part";
  write_csv(table, data);
  std::vector<std::string> arguments = {data.string(), "--output", output.plot, "--x",
                                        output.x,      "--y",      output.y};
  if (!output.overlay.empty()) {
    arguments.emplace_back("--overlay");
    arguments.insert(arguments.end(), output.overlay.begin(), output.overlay.end());
  }
  process::draw_with("scripts/plot_curves.py", arguments);
  std::filesystem::remove(data);
  fmt::print("written: {}\n", output.plot);
}

}  // namespace whipple::app

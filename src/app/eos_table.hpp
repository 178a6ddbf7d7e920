// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "eos/equation_of_state.hpp"

/// Tables of `whipple eos`: on the terminal and as CSV.
namespace whipple::app {

struct Column {
  std::string name;          ///< with its unit, as in the CSV files of experiments: "P_GPa"
  std::string unit;          ///< as printed: "GPa"; empty: none
  double size = 1;           ///< of the printed unit in SI
  std::string meaning = {};  ///< for the axes of figures and lists: "pressure"
  bool in_curves = true;     ///< printed in the table of a curve; all columns go to the CSV
};

/// A number in SI, or a word.
using Cell = std::variant<double, std::string>;
using CurveRow = std::vector<Cell>;

/// One curve of a table.
struct Series {
  std::string name;  ///< the material's
  std::vector<CurveRow> rows;
};

struct CurveTable {
  std::string title;  ///< first line of the CSV: what it is
  std::vector<Column> columns;
  std::vector<Series> series;  ///< with more than one, the first column printed names it
};

/// Columns of a state and its cells; ratios to the reference density of the model.
std::vector<Column> state_columns();
CurveRow state_cells(const eos::State& state, const eos::EquationOfState& eos);

/// Index of a column.
/// @throws InputError with the names of the others
std::size_t column_index(const CurveTable& table, const std::string& name);

/// On standard output, numbers aligned; columns without any known value are left out.
void print(const CurveTable& table);
/// The first row of each series as a list, one quantity a line.
void print_list(const CurveTable& table);

/// @throws InputError if the file cannot be written
void write_csv(const CurveTable& table, const std::filesystem::path& path);

}  // namespace whipple::app

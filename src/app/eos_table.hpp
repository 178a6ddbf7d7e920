// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "eos/equation_of_state.hpp"

/// Tables of `whipple eos`: on the terminal, as CSV and as figure.
namespace whipple::app {

struct Column {
  std::string name;  ///< with its unit, as in the CSV files of experiments: "P_GPa"
  std::string unit;  ///< as printed: "GPa"; empty: none
  double size = 1;   ///< of the printed unit in SI
};

/// A number in SI, or a word.
using Cell = std::variant<double, std::string>;

struct CurveTable {
  std::string title;  ///< first line of the CSV: what it is, of which material
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
};

/// Columns of a state and its cells; ratios to the reference density of the model.
std::vector<Column> state_columns();
std::vector<Cell> state_cells(const eos::State& state, const eos::EquationOfState& eos);

/// On standard output, numbers aligned; columns without any known value are left out.
void print(const CurveTable& table);

/// Where a table goes besides the terminal.
struct CurveOutput {
  std::string csv;
  std::string plot;
  std::string x, y;                  ///< columns of the figure
  std::vector<std::string> overlay;  ///< CSV files with the same column names
  bool force = false;
};
/// @throws InputError if a file exists and may not be overwritten; called before anything is computed
void require_writable(const CurveOutput& output);
/// Prints the table, writes the CSV and draws the figure.
void write(const CurveTable& table, const CurveOutput& output);

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "eos/equation_of_state.hpp"

/// Curves computed from equations of state and returned as data: tables in SI with the units to show them in.
namespace whipple::eos::curves {

/// One quantity of a table: its names, and the unit that it is shown in.
struct Column {
  std::string name;       ///< with its unit, as in the CSV files of experiments: "P_GPa"
  std::string unit;       ///< as printed: "GPa"; empty: none
  double size = 1;        ///< of that unit in SI
  std::string meaning;    ///< for the axes of figures and lists: "pressure"
  bool in_curves = true;  ///< printed in the table of a curve; all columns go to the CSV
};

/// Makes a column; the size of its unit follows from the SI unit of its cells.
/// @throws InputError if the units are of different kinds
Column quantity_column(std::string name, std::string unit, const std::string& si_unit, std::string meaning,
                       bool in_curves = true);
/// Makes a column of numbers without unit, or of words.
Column plain_column(std::string name, std::string meaning);

/// A number in SI, or a word.
using Cell = std::variant<double, std::string>;
using CurveRow = std::vector<Cell>;

/// One curve of a table.
struct Series {
  std::string name;  ///< of the equation of state
  std::vector<CurveRow> rows;
  std::string end = {};  ///< why the model ends before the last value asked for; empty: it does not
};

struct CurveTable {
  std::string title;
  std::vector<Column> columns;
  std::vector<Series> series;
};

/// Columns of a state.
const std::vector<Column>& state_columns();
/// Column of a state by name.
/// @throws InternalError if there is none
const Column& state_column(const std::string& name);
/// Cells of a state in the order of `state_columns`; ratios to the reference density of the model.
CurveRow state_cells(const State& state, const EquationOfState& eos);

/// Index of a column.
/// @throws InputError with the names of the others
std::size_t column_index(const CurveTable& table, const std::string& name);

/// Returns values at equal distances, ends included.
std::vector<double> spaced(double from, double to, int points);

}  // namespace whipple::eos::curves

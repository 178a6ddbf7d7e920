// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "eos/equation_of_state.hpp"

/// Defines curves computed from equations of state as data: tables in SI with display units.
namespace whipple::eos::curves {

/// Describes one quantity of a table: its names and its display unit.
struct Column {
  std::string name;       ///< with its unit, as in the CSV files of experiments: "P_GPa"
  std::string unit;       ///< as printed: "GPa"; empty: none
  double size = 1;        ///< size of that unit in SI
  std::string meaning;    ///< for the axes of figures and lists: "pressure"
  bool in_curves = true;  ///< printed in the table of a curve; all columns go to the CSV
};

/// Makes a column; the size of its unit follows from the SI unit of its cells.
/// @throws InputError if the units are of different kinds
Column quantity_column(std::string name, std::string unit, const std::string& si_unit, std::string meaning,
                       bool in_curves = true);
/// Makes a column of numbers without unit, or of words.
Column plain_column(std::string name, std::string meaning);

/// Holds a number in SI, or a word.
using Cell = std::variant<double, std::string>;
using CurveRow = std::vector<Cell>;

/// Holds one curve of a table.
struct Series {
  std::string name;  ///< of the equation of state
  std::vector<CurveRow> rows;
  std::string end = {};  ///< reason why the model ends before the last requested value; empty: it does not
};

struct CurveTable {
  std::string title;
  std::vector<Column> columns;
  std::vector<Series> series;
};

/// Returns the columns of a state.
const std::vector<Column>& state_columns();
/// Returns the column of a state by name.
/// @throws InternalError if there is none
const Column& state_column(const std::string& name);
/// Returns the cells of a state in the order of `state_columns`; ratios are to the reference density of the model.
CurveRow state_cells(const State& state, const EquationOfState& eos);

/// Returns the index of a column.
/// @throws InputError listing the names of all columns
std::size_t column_index(const CurveTable& table, const std::string& name);

/// Returns values at equal distances, ends included.
std::vector<double> spaced(double from, double to, int points);

}  // namespace whipple::eos::curves

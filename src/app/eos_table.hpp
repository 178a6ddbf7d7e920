// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "eos/curves/table.hpp"

/// Writes the tables of `whipple eos`, on the terminal and as CSV. With more than one series, the first printed column
/// names the series.
namespace whipple::app {

/// Prints a table on standard output with aligned numbers; columns without any known value are omitted.
void print(const eos::curves::CurveTable& table);
/// Prints the first row of each series as a list, one quantity per line.
void print_list(const eos::curves::CurveTable& table);

/// Returns a table as CSV, with its title in the first line.
std::string csv_text(const eos::curves::CurveTable& table);
/// Returns the table as JSON: a list of rows for each material, each with the columns of the CSV; null for unknown
/// values.
std::string table_as_json(const eos::curves::CurveTable& table);

/// Returns whether an output file is named "-": standard output, which then contains nothing else.
bool is_standard_output(const std::string& name);

/// Writes a text to an output file or to standard output; does nothing if the name is empty.
/// @throws InputError if the file cannot be written
void write_output(const std::string& name, const std::string& text);

}  // namespace whipple::app

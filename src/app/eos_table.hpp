// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "eos/curves/table.hpp"

/// Tables of `whipple eos`: on the terminal and as CSV. With more than one series, the first column printed names it.
namespace whipple::app {

/// Prints a table on standard output, numbers aligned; columns without any known value are left out.
void print(const eos::curves::CurveTable& table);
/// Prints the first row of each series as a list, one quantity a line.
void print_list(const eos::curves::CurveTable& table);

/// Returns a table as CSV, its title in the first line.
std::string csv_text(const eos::curves::CurveTable& table);
/// The table as JSON: for each material a list of rows, each with the columns of the CSV; null for what is not known.
std::string json_text(const eos::curves::CurveTable& table);

/// Returns whether the name of an output file, "-", means standard output, which then holds nothing else.
bool is_standard_output(const std::string& name);

/// Writes the text of an output file, or of standard output; nothing if the name is empty.
/// @throws InputError if the file cannot be written
void write_output(const std::string& name, const std::string& text);

}  // namespace whipple::app

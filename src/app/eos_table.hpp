// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "eos/curves/table.hpp"

/// Tables of `whipple eos`: on the terminal and as CSV. With more than one series, the first column printed names it.
namespace whipple::app {

/// Prints a table on standard output, numbers aligned; columns without any known value are left out.
void print(const eos::curves::CurveTable& table);
/// Prints the first row of each series as a list, one quantity a line.
void print_list(const eos::curves::CurveTable& table);

/// Writes a table as CSV, its title in the first line.
/// @throws InputError if the file cannot be written
void write_csv(const eos::curves::CurveTable& table, const std::filesystem::path& path);

}  // namespace whipple::app

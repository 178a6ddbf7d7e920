// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "src/analysis/table.hpp"

namespace whipple::analysis {

/// Describes a measure of a run: an entry of quantities.csv, and a column of series.csv if it exists at every time.
struct Measure {
  std::string_view name;     ///< ends in ".BODY" if there is one for every body
  std::string_view unit;     ///< SI
  std::string_view meaning;  ///< one phrase
  std::string_view missing;  ///< default reason why it is NaN; empty: it never is
};

/// Lists all measures, each once.
std::span<const Measure> measures();

/// Creates the quantity of a measure of the table.
/// @param reason  why the value is NaN, instead of the reason of the table
/// @throws InternalError if the table has no such measure
Quantity measured(std::string_view name, double value, std::string reason = {});

/// Creates the quantity of a measure "NAME.BODY" of the table for a body.
/// @param reason  why the value is NaN, instead of the reason of the table
/// @throws InternalError if the table has no such measure
Quantity measured(std::string_view name, const std::string& body, double value, std::string reason = {});

/// Writes the table of all measures for docs/manual/output.md.
std::string measures_as_markdown();

/// Writes FOLDER/quantities.csv: quantity, value, unit, meaning, and the reason if the value is NaN.
/// @throws InputError if the file cannot be written
void write_quantities(const Quantities& values, const std::filesystem::path& folder);

/// Reads FOLDER/quantities.csv.
/// @throws InputError if the file is missing or damaged
Quantities read_quantities(const std::filesystem::path& folder);

}  // namespace whipple::analysis

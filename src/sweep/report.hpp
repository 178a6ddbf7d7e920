// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "src/sweep/results.hpp"

namespace whipple::sweep {

/// Writes the tables of a study into its folder: points.csv, bands.csv, sensitivities.csv, limits.csv, study.h5 with
/// the same tables, and study.json for other programs.
/// @throws InputError if a file cannot be written
void write_tables(const Results& results, const std::filesystem::path& folder);

/// Returns the tables as JSON: lists of rows, and units of the columns; NaN is null.
std::string as_json(const Results& results);

/// Draws a figure per result into the folder figures.
/// @throws InputError if they cannot be drawn
void draw_figures(const std::filesystem::path& folder);

/// Returns the limits and the failed points in words, a line each.
std::string summary(const Results& results);

}  // namespace whipple::sweep

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eos/curves/diagrams.hpp"

/// Implements the figures of `whipple eos`, drawn by scripts/plot_curves.py (PNG, PDF or SVG, by file extension).
namespace whipple::app {

/// Adds measurements of the two quantities of the axes as points.
/// @param experiments  paths or names as for `process::find_experiment`
/// @throws InputError if a file lacks the columns
void add_measurements(eos::curves::Figure& figure, const std::vector<std::string>& experiments);

/// Draws a figure into a file.
/// @throws InputError if it cannot be drawn
void draw(const eos::curves::Figure& figure, const std::filesystem::path& path);

}  // namespace whipple::app

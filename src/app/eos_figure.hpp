// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eos/curves/diagrams.hpp"

/// Figures of `whipple eos`, drawn by scripts/plot_curves.py (PNG, PDF or SVG by the ending of the file).
namespace whipple::app {

/// Finds a table of measurements: a path, or a bare file name of those that come with the program (eos/data).
/// @throws InputError if there is no such file
std::filesystem::path find_experiment(const std::string& name);

/// Adds measurements of the two quantities of the axes as points.
/// @param experiments  as of `find_experiment`
/// @throws InputError if a file has not the columns
void add_measurements(eos::curves::Figure& figure, const std::vector<std::string>& experiments);

/// Draws a figure into a file.
/// @throws InputError if it cannot be drawn
void draw(const eos::curves::Figure& figure, const std::filesystem::path& path);

}  // namespace whipple::app

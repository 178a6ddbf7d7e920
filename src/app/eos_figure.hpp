// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/app/eos_table.hpp"

/// Figures of `whipple eos`, drawn by scripts/plot_curves.py (PNG, PDF or SVG by the ending of the file).
namespace whipple::app {

/// A line, or separate points.
struct FigureCurve {
  std::string label;            ///< what it is: "Hugoniot", or the name of the measurements
  std::string material;         ///< of which material; measurements have none
  std::vector<double> x, y;     ///< in the units of the axes
  int colour = 0;               ///< one of the palette; curves of one material share it
  std::string style = "solid";  ///< solid | dashed | dotted | dashdot | thin | marks
};

struct Figure {
  std::string title;
  Column x, y;  ///< what the axes show
  bool logarithmic_x = false, logarithmic_y = false;
  std::vector<FigureCurve> curves;
  std::vector<FigureCurve> points;  ///< measurements
};

/// Measurements of the two quantities of the axes: CSV files, or names of those in eos/data.
/// @throws InputError if a file has not the columns
void add_measurements(Figure& figure, const std::vector<std::string>& experiments);

/// @throws InputError if the figure cannot be drawn
void draw(const Figure& figure, const std::filesystem::path& path);

}  // namespace whipple::app

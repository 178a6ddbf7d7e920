// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "src/analysis/views.hpp"

namespace whipple::app {

/// Holds the options of the analysis as text, shared by `analyse` and `report`.
struct AnalysisWords {
  bool by_distance = false;
  std::string axis, link, witness, loads, diameter_at, peak_decay, pixel, spot = "1 mm";
  std::vector<std::string> attenuation;
  int radiographs = 6;
  analysis::ViewOptions views;  ///< of the page
};

/// Adds the options of the analysis to a command.
void add_analysis_options(CLI::App& command, AnalysisWords& words);

/// Measures the run and writes the tables into `output`.
/// @throws InputError if an option is not a quantity, or as analysis::analyse
void run_analysis(const std::filesystem::path& run, const AnalysisWords& words,
                  const std::filesystem::path& output);

/// Adds `whipple analyse`: measures of a run as CSV and HDF5.
void add_analyse_command(CLI::App& app);

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/analysis/table.hpp"

/// Measures of a run that are taken on request, since they need names of gauges or bodies and parameters.
namespace whipple::analysis {

/// Names and parameters of a request; SI units.
struct Request {
  std::filesystem::path folder;      ///< of the run
  std::vector<std::string> names{};  ///< gauges, groups of tracers, bodies, quantities
  double place = nan;                ///< m
  double travel = nan;               ///< m
  double speed = nan;                ///< m/s
  double fraction = nan;             ///< 1
  double time = nan;                 ///< s
  std::filesystem::path table{};     ///< of an exact solution, or of a measured history
};

/// Describes a measure on request.
struct RequestedMeasure {
  std::string_view kind;
  std::string_view names;       ///< e.g. "TRACERS.GAUGE"
  std::string_view parameters;  ///< keys that it needs, separated by blanks
  std::string_view unit;        ///< SI; empty: that of the column
  std::string_view meaning;     ///< one phrase
  std::string_view missing;     ///< reason why it is NaN
  double (*value)(const Request& request);
};

/// Lists the measures on request, each once.
std::span<const RequestedMeasure> requested_measures();

/// Takes a measure.
/// @param text  "KIND.NAMES", then "KEY=VALUE" for each parameter, separated by blanks: "jet_speed.liner fraction=1 %",
///              "wall_speed.wall place=30 mm travel=4 mm"; a path is relative to the working directory
/// @returns the quantity under the whole text as its name
/// @throws InputError naming the text, the names and keys that the measure takes, or what the run does not have
Quantity take_on_request(const std::filesystem::path& folder, const std::string& text);

/// Writes the table of these measures for docs/manual/output.md.
std::string requested_measures_as_markdown();

// Along gauges and tracers (gauge_requests.cpp).
double wall_speed(const Request& request);
double arrival_speed(const Request& request);
double run_distance(const Request& request);
double peak(const Request& request);
double change(const Request& request);
double change_error(const Request& request);
double peak_change(const Request& request);
double arrival(const Request& request);
double history_error(const Request& request);
double history_shift(const Request& request);
// Of tests of fracture (fracture_requests.cpp).
double mean_force(const Request& request);
double peak_stress(const Request& request);
double neck_strain(const Request& request);
double elongation(const Request& request);
double failure_strain(const Request& request);
double failure_triaxiality(const Request& request);
double shear_strength(const Request& request);
double shear_stroke(const Request& request);
// Of the particles of a body (particle_requests.cpp).
double profile_error(const Request& request);
double reach(const Request& request);
double height(const Request& request);
double jet_speed(const Request& request);
double jet_gap(const Request& request);
double jet_fraction(const Request& request);

}  // namespace whipple::analysis

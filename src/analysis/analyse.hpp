// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "src/analysis/run.hpp"
#include "src/analysis/views.hpp"

namespace whipple::analysis {

struct Options {
  double link = 0.0;               ///< linking length of fragments, m; 0: 1.5 cells
  bool by_distance = false;        ///< also tabulates pieces of all particles by distance alone
  std::optional<double> witness;   ///< axial coordinate of a witness plate, m
  std::string loads;               ///< body at whose face the loads are measured; empty: none
  std::optional<double> loads_at;  ///< axial coordinate of a plane at which they are measured instead, m
  double diameter_at = 0.0;        ///< for bars: distance from the wall, m; 0: not requested
  std::optional<int> axis;         ///< flight axis 0, 1 or 2 instead of the detected one
  std::string peak_decay;          ///< body whose peak pressure is tracked; empty: none
  double pixel = 0.0;              ///< of radiographs, m; 0: half the cell size
  double spot = 1e-3;              ///< full width at half maximum of the radiograph blur, m
  ViewOptions views;               ///< pictures for the page of `whipple report`
  int radiographs = 6;             ///< number of radiographs, evenly spread over the snapshots
  /// Holds mass attenuation coefficients by body, m^2/kg; bodies without an entry use that of aluminium at 150 keV
  /// (Hubbell and Seltzer, NISTIR 5632 (1995)).
  std::map<std::string, double> attenuation;
};

/// Measures a run and writes into `folder`: quantities.csv (final values), series.csv (one row per snapshot),
/// bodies.csv, fragments.csv, fragment_distribution.csv, profile.csv; pieces_by_distance.csv, peak_pressure.csv,
/// witness_*.csv and loads_*.csv where requested; and analysis.h5 with all of them, the radiographs and the views
/// (docs/manual/output.md).
/// @throws InputError if the run has no snapshots, does not contain a body named in the options, or the output cannot
/// be written
void analyse(const Run& run, const Options& options, const std::filesystem::path& folder);

}  // namespace whipple::analysis

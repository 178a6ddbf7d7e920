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
  bool by_distance = false;        ///< also pieces of all particles by distance alone
  std::optional<double> witness;   ///< axial coordinate of a witness plate, m
  std::string loads;               ///< body on whose face the loads are measured; empty: none
  std::optional<double> loads_at;  ///< axial coordinate of a plane on which they are measured instead, m
  double diameter_at = 0.0;        ///< of bars: distance from the wall, m; 0: not asked for
  std::optional<int> axis;         ///< of the flight: 0, 1, 2 instead of what is found
  std::string peak_decay;          ///< body whose peak pressure is followed; empty: none
  double pixel = 0.0;              ///< of radiographs, m; 0: half the cell size
  double spot = 1e-3;              ///< blur of radiographs, full width at half maximum, m
  ViewOptions views;               ///< pictures for the page of `whipple report`
  int radiographs = 6;             ///< at so many times, evenly spread over the snapshots
  /// Mass attenuation coefficients by body, m^2/kg; bodies without one take that of aluminium at 150 keV
  /// (Hubbell and Seltzer, NISTIR 5632 (1995)).
  std::map<std::string, double> attenuation;
};

/// Measures a run and writes into `folder`: quantities.csv (final values), series.csv (a row per snapshot),
/// bodies.csv, fragments.csv, fragment_distribution.csv, profile.csv, pieces_by_distance.csv, peak_pressure.csv,
/// witness_*.csv and loads_*.csv where asked for, and analysis.h5 with all of them, the radiographs and views (docs/manual/output.md).
/// @throws InputError if the run has no snapshots, a body of the options is not in it, or the output cannot
/// be written
void analyse(const Run& run, const Options& options, const std::filesystem::path& folder);

}  // namespace whipple::analysis

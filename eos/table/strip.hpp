// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "eos/table/builder.hpp"
#include "eos/table/sampler.hpp"

/// Constructs a table, strip by strip (docs/theory/equations_of_state.md, section "Tables").
namespace whipple::eos::table {

/// Returns a floor of c^2 (m^2/s^2) for the scales by which errors are measured: p passes through zero, and c^2 does
/// so in the loop of a metastable fluid.
inline double soft_square(double reference_sound_speed) {
  return 0.01 * reference_sound_speed * reference_sound_speed;
}
inline double pressure_scale(double pressure, double rho, double squared_sound_speed, double soft) {
  return std::abs(pressure) + 0.01 * rho * (squared_sound_speed + soft);
}

/// Describes the division of a region, numbered after the preceding cuts, at a fraction of its height in z, which
/// adds resolution where a phase needs it.
struct Cut {
  std::size_t region;
  double share;
};

/// Specifies the densities to be fitted; the samples stay between `first_sample` and `last_sample`, on one side of
/// a density at which the phases change.
struct StripTask {
  double begin, end, first_sample, last_sample;
  std::vector<Cut> cuts = {};
  double miss_of_whole = INFINITY;  ///< error along y, over the request, in the strip that was halved
  bool last_attempt = false;        ///< a non-converged fit is accepted, and appears in the verification
};

struct FittedStrip {
  bool converged = false;  ///< otherwise the strip must be cut again or halved
  std::optional<Cut> cut;
  double miss = INFINITY;  ///< remaining error along y, over the request, if it prevented convergence
  TableData::Strip strip;  ///< its indices refer to the vectors below
  std::vector<TableData::Interval> intervals;
  std::vector<double> cells;
  std::vector<std::array<std::uint16_t, 2>> fractions;
  std::vector<std::string_view> phases;
};

FittedStrip fit_strip(const Sampler& sampler, const StripTask& task, const TableData& constants,
                      double error);

/// Appends a fitted strip to a table.
void append(TableData& data, const FittedStrip& fitted);

}  // namespace whipple::eos::table

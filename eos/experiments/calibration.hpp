// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "eos/experiments/comparison.hpp"

namespace whipple::eos::experiments {

/// Nominal coverages at which a band is checked.
inline constexpr std::array coverage_levels = {0.5, 0.68, 0.8, 0.9, 0.95, 0.99};
/// Half-width of the 95 % band in standard deviations of a normal distribution.
inline constexpr double half_width_95 = 1.959964;

/// Does the uncertainty of an equation of state hold the measurements? Of each point of an experiment; SI.
struct Calibration {
  std::vector<double> model;              ///< of the equation of state itself; NaN outside its range
  std::vector<double> deviation;          ///< standard deviation over the samples
  std::vector<double> measurement_error;  ///< one standard deviation; NaN: not known
  std::vector<double> pull;  ///< (model - measured) over both errors; NaN where the point does not count
  int points = 0;            ///< that count for the coverage
  int band_points = 0;       ///< that have a band; their measurement error may be unknown
  std::array<double, coverage_levels.size()> coverage{};  ///< fraction of |pull| within each level
  double coverage_of_band = 0.0;                          ///< within the 95 % band of the model alone
  double median_half_width = 0.0;                         ///< of that band, relative to the measured ordinate
  double median_error = 0.0;  ///< of the measurement, relative to the measured ordinate
};

/// One standard deviation of each ordinate: where the file states errors, these (with the error of the abscissa by the
/// slope of the model); else, of shock velocities, sound speeds and temperatures, the rms deviation of the points from
/// their own quadratic in the abscissa, n - 3. Pressures over volume bend more than a quadratic does: what is left of
/// them is no error of measurement, and without stated errors it is not known (NaN).
/// @param slope  d(ordinate)/d(abscissa) of the model at each point
/// @throws InputError for fewer than four points without stated errors
std::vector<double> measurement_errors(const Experiment& experiment, std::span<const double> slope);

/// Compares the scatter over samples of an equation of state with an experiment. A point has a band if the equation of
/// state and more than half of the samples have a state there, and counts for the coverage if its error is known.
/// @param samples  with their initial states, two or more
Calibration calibrate(const EquationOfState& eos, const State& initial,
                      std::span<const std::pair<const EquationOfState*, State>> samples,
                      const Experiment& experiment);

}  // namespace whipple::eos::experiments

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

/// Describes whether the uncertainty of an equation of state covers the measurements, for each point of an
/// experiment; SI.
struct Calibration {
  std::vector<double> model;              ///< value of the equation of state; NaN outside its range
  std::vector<double> deviation;          ///< standard deviation over the samples
  std::vector<double> measurement_error;  ///< one standard deviation; NaN: unknown
  std::vector<double> pull;  ///< (model - measured) over both errors; NaN for points that are not counted
  int points = 0;            ///< points counted for the coverage
  int band_points = 0;       ///< points with a band; their measurement error may be unknown
  std::array<double, coverage_levels.size()> coverage{};  ///< fraction of |pull| within each level
  double coverage_of_band = 0.0;                          ///< within the 95 % band of the model alone
  double median_half_width = 0.0;                         ///< of that band, relative to the measured ordinate
  double median_error = 0.0;  ///< of the measurement, relative to the measured ordinate
};

/// Returns one standard deviation of each ordinate. If the file states errors, these are used (including the error
/// of the abscissa through the slope of the model); otherwise, for shock velocities, sound speeds and temperatures,
/// the rms deviation of the points from their quadratic fit in the abscissa, with n - 3 degrees of freedom.
/// Pressures over volume deviate systematically from a quadratic: their residual is not a measurement error, which
/// is unknown (NaN) unless stated.
/// @param slope  d(ordinate)/d(abscissa) of the model at each point
/// @throws InputError for fewer than four points without stated errors
std::vector<double> measurement_errors(const Experiment& experiment, std::span<const double> slope);

/// Compares the scatter over samples of an equation of state with an experiment. A point has a band if the equation of
/// Compares the scatter over samples of an equation of state with an experiment. A point has a band if the equation of
/// @param samples  with their initial states, two or more
Calibration calibrate(const EquationOfState& eos, const State& initial,
                      std::span<const std::pair<const EquationOfState*, State>> samples,
                      const Experiment& experiment);

}  // namespace whipple::eos::experiments

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "eos/experiments/experiment.hpp"
#include "src/core/base/error_tier.hpp"
#include "src/material/material.hpp"

/// `whipple compare --samples`: do the bands of fitted materials hold the measurements?
namespace whipple::app {

struct CalibrationOptions {
  int samples = 0;  ///< 0: no calibration
  std::uint64_t seed = 1;
  std::string tier{word_of(ErrorTier::fit)};
  std::string csv;  ///< of every point; empty: none
};

/// One material with one experiment.
struct CalibratedPair {
  const eos::experiments::Experiment* experiment;
  const Material* material;
  std::string label;  ///< of the material
};

/// Draws samples of each material, compares their scatter with the measurements, writes the points to the CSV of the
/// options, and returns the table: points, median half-width of the 95 % band, median error of the measurement, the
/// fractions of points within the nominal levels.
/// @throws InputError if a material has no covariance of that tier
std::string calibration_report(const std::vector<CalibratedPair>& pairs, const CalibrationOptions& options);

}  // namespace whipple::app

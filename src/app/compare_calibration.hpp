// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "eos/experiments/experiment.hpp"
#include "src/core/base/error_tier.hpp"
#include "src/material/material.hpp"
#include "src/material/material_samples.hpp"

/// Implements `whipple compare --samples`, which checks whether the bands of fitted materials contain the measurements.
namespace whipple::app {

struct CalibrationOptions {
  int samples = 0;  ///< 0: no calibration
  std::uint64_t seed = 1;
  std::string tier{word_of(ErrorTier::fit)};
  std::string csv;  ///< file for all points; empty: none
};

/// Pairs one material with one experiment.
struct CalibratedPair {
  const eos::experiments::Experiment* experiment;
  const Material* material;
  std::string label;  ///< of the material
};

/// Maps the fitted materials to their samples.
using DrawnMaterials = std::map<const Material*, MaterialSamples>;

/// Draws samples of each fitted material.
/// @throws InputError if none is fitted, or one has no covariance of that tier
DrawnMaterials draw_fitted(const std::vector<CalibratedPair>& pairs, const CalibrationOptions& options);

/// Returns the equations of state of samples with their initial states.
std::vector<std::pair<const eos::EquationOfState*, eos::State>> states_at_rest(
    const MaterialSamples& samples);

/// Compares the scatter of the samples with the measurements, writes the points to the CSV file of the options, and
/// returns the table: number of points, median half-width of the 95 % band, median error of the measurement, and the
/// fractions of points within the nominal levels. Materials that are not fitted have a row without values.
std::string calibration_report(const std::vector<CalibratedPair>& pairs, const DrawnMaterials& drawn,
                               const CalibrationOptions& options);

}  // namespace whipple::app

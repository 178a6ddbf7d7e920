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

/// Samples of the fitted ones among some materials.
using DrawnMaterials = std::map<const Material*, MaterialSamples>;

/// Draws samples of each fitted material.
/// @throws InputError if none is fitted, or one has no covariance of that tier
DrawnMaterials draw_fitted(const std::vector<CalibratedPair>& pairs, const CalibrationOptions& options);

/// Equations of state of samples with their initial states.
std::vector<std::pair<const eos::EquationOfState*, eos::State>> states_at_rest(
    const MaterialSamples& samples);

/// Compares the scatter of the samples with the measurements, writes the points to the CSV of the
/// options, and returns the table: points, median half-width of the 95 % band, median error of the measurement, the
/// fractions of points within the nominal levels. Materials that are not fitted have a row without figures.
std::string calibration_report(const std::vector<CalibratedPair>& pairs, const DrawnMaterials& drawn,
                               const CalibrationOptions& options);

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "eos/models/corrected_gray_surfaces.hpp"
#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/correction/left_out_curves.hpp"
#include "md_fitting/fit/joint/measured_curves.hpp"
#include "src/core/base/error.hpp"

/// Fits smooth corrections of GRAY's free energies to the states of a store (docs/theory/fit.md, section 10).
namespace whipple::fit {

/// Holds the residuals of one kind of data before and after the correction.
struct CorrectionResiduals {
  std::string kind;
  int data = 0;
  double gray = 0.0, corrected = 0.0;  ///< rms over the scale of the data: a bulk modulus, 3RT, ...
  double of_errors = 0.0;              ///< rms of the corrected over their errors
};

/// Holds one datum before and after the correction, over the scale of its kind.
struct CorrectionRow {
  std::string kind;
  double volume = 0.0, temperature = 0.0;           ///< m^3/kg, K; of the first state of the datum
  double gray = 0.0, corrected = 0.0, error = 0.0;  ///< datum less model; one standard deviation
};

/// Holds the estimated size of one part of the corrections.
struct CorrectionSize {
  std::string name;
  double factor = 1.0;  ///< of the size expected before the data
};

struct CorrectionResult {
  eos::CorrectionConstants common, fluid;
  std::vector<CorrectionResiduals> residuals;
  std::vector<CorrectionRow> rows;
  std::vector<CorrectionSize> sizes;
  std::vector<LeftOutCurves> left_out;  ///< coverage on data that were not seen
  double energy_zero = 0.0;             ///< J/kg, of the simulation at the reference state of the model
  int limited = 0;                      ///< states at which stability decided
  std::string remark{};                 ///< on data that were left out
  std::vector<eos::CorrectedGrayConstants> samples{};  ///< drawn from the posterior distribution
};

/// Holds what a correction is fitted to.
struct CorrectionSource {
  std::span<const md::PointRecord> points;
  eos::GrayConstants simulated;  ///< constants at V0 of the simulations
  eos::GrayConstants metal;      ///< the same at V0 of the metal: of the material
  std::span<const MeasuredCurve> measured{};
};

/// Says that the most probable correction makes a material and draws of it do not.
class DrawsRefused : public InputError {
 public:
  using InputError::InputError;
};

/// Fits the corrections and draws samples of them. Films from which no dome of melt and vapour follows are left out,
/// with a remark.
/// Electrons are taken out of what is compared with simulations.
/// @param samples  number
/// @throws InputError if the corrected phases make no material, DrawsRefused if their draws make none; StateError if no
/// stable correction is found
CorrectionResult fit_correction(const CorrectionSource& source, int samples, std::uint64_t seed);

/// Formats the table of residuals and sizes.
std::string correction_text(const CorrectionResult& result);

}  // namespace whipple::fit

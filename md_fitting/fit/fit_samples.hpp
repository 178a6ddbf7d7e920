// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "md_fitting/fit/fit_result.hpp"
#include "md_fitting/fit/potential_spread.hpp"
#include "src/core/base/error_tier.hpp"

namespace whipple::fit {

/// Holds fits whose constants are drawn from the normal distribution given by the covariance of a fit: an ensemble
/// of materials. A draw that does not yield a valid material is replaced. The sources of drawn constants record
/// the draw, and the samples have no covariance.
struct FitSamples {
  std::vector<Fit> fits;
  int refused = 0;  ///< draws that were replaced
};

/// Draws samples of a fit.
/// @param tier    errors to draw from; those of the fit include the known errors of the defaults
/// @param spread  over potentials, for the second tier
/// @throws InputError if four out of five draws are rejected, or if the second tier is missing
FitSamples sample_fit(const Fit& fit, int count, std::uint64_t seed, ErrorTier tier = ErrorTier::fit,
                      const std::optional<PotentialSpread>& spread = std::nullopt);

/// Returns fits with the corrections drawn together with a corrected fit; their constants are its own.
FitSamples correction_samples(const Fit& fit);

}  // namespace whipple::fit

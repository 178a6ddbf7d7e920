// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "md_fitting/fit/fit_result.hpp"
#include "md_fitting/fit/potential_spread.hpp"
#include "src/core/base/error_tier.hpp"

namespace whipple::fit {

/// Fits whose constants are drawn from the normal distribution of a fit's covariance: an ensemble of
/// materials. A draw of which the model makes no material is replaced by another one. The drawn constants say
/// so, and there is no covariance any more.
struct FitSamples {
  std::vector<Fit> fits;
  int refused = 0;  ///< draws that were replaced
};

/// @param tier    errors to draw from: that of the fit contains the known errors of the defaults
/// @param spread  over potentials, for the second tier
/// @throws InputError if four of five draws are refused, or the second tier is missing
FitSamples sample_fit(const Fit& fit, int count, std::uint64_t seed, ErrorTier tier = ErrorTier::fit,
                      const std::optional<PotentialSpread>& spread = std::nullopt);

}  // namespace whipple::fit

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "md_fitting/fit/fit_result.hpp"

namespace whipple::fit {

/// Fits whose constants are drawn from the normal distribution of a fit's covariance: an ensemble of
/// materials. A draw of which the model makes no material is replaced by another one. The drawn constants say
/// so, and there is no covariance any more.
struct FitSamples {
  std::vector<Fit> fits;
  int refused = 0;  ///< draws that were replaced
};

/// @throws InputError if four of five draws are refused
FitSamples sample_fit(const Fit& fit, int count, std::uint64_t seed);

}  // namespace whipple::fit

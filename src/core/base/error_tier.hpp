// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "src/core/base/words.hpp"

namespace whipple {

/// Errors of the constants of a fitted material that samples are drawn from (docs/theory/fit.md, section 3).
enum class ErrorTier {
  fit,         ///< covariance of the fit, and errors of the defaults where they are known
  potentials,  ///< scatter over the potentials of the element
  all          ///< both, independent of one another
};

constexpr std::array<Word<ErrorTier>, 3> words(ErrorTier) {
  return {{{ErrorTier::fit, "fit"}, {ErrorTier::potentials, "potentials"}, {ErrorTier::all, "all"}}};
}

}  // namespace whipple

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "src/core/base/words.hpp"

namespace whipple {

/// Errors of the constants of a fitted material that samples are drawn from (docs/theory/fit.md, section 3).
enum class ErrorTier {
  noise,       ///< statistical part of the covariance of the fit alone
  fit,         ///< covariance of the fit, and errors of the defaults where they are known
  potentials,  ///< scatter over the potentials of the element
  all          ///< fit and potentials, independent of one another
};

/// Returns whether the scatter over the potentials counts.
constexpr bool over_potentials(ErrorTier tier) {
  return tier == ErrorTier::potentials || tier == ErrorTier::all;
}

constexpr std::array<Word<ErrorTier>, 4> words(ErrorTier) {
  return {{{ErrorTier::noise, "noise"},
           {ErrorTier::fit, "fit"},
           {ErrorTier::potentials, "potentials"},
           {ErrorTier::all, "all"}}};
}

}  // namespace whipple

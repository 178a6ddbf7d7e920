// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "src/core/base/words.hpp"

namespace whipple {

/// Selects the errors of the constants of a fitted material from which samples are drawn (docs/theory/fit.md, section
/// 3).
enum class ErrorTier {
  noise,       ///< statistical part of the covariance of the fit only
  fit,         ///< covariance of the fit, and errors of the defaults where known
  potentials,  ///< scatter over the potentials of the element
  all          ///< fit and potentials, independent of each other
};

/// Returns whether the scatter over the potentials is included.
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

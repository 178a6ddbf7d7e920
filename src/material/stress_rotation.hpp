// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/core/base/words.hpp"

namespace whipple::material {

/// Selects how strain increment and rotation of a step follow from its velocity gradient (docs/theory/material.md,
/// section 2).
enum class StressRotation : std::uint8_t {
  hughes_winget,  ///< both refer to the configuration in the middle of the step
  polar,          ///< of the polar decomposition I + dt L = V R
};
constexpr std::array<Word<StressRotation>, 2> words(StressRotation) {
  return {{{StressRotation::hughes_winget, "hughes_winget"}, {StressRotation::polar, "polar"}}};
}

}  // namespace whipple::material

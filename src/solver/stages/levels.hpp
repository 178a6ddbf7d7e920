// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/state.hpp"

namespace whipple::solver {

/// Watches the particles with functions of two cell sizes (docs/theory/levels.md, section 5): counts those under a strong
/// shock. Call after binning and `separate_fields`. Collective.
/// @throws StateError on every rank if one of them is in contact with another body, or with a wall or its image
void watch_levels(State& state);

}  // namespace whipple::solver

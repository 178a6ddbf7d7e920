// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "src/solver/state.hpp"

namespace whipple::solver {

/// Watches the particles with functions of two cell sizes (docs/theory/levels.md, section 5): counts those under a strong
/// shock. Call after binning and `separate_fields`. Collective.
/// @throws StateError on every rank if one of them may be in contact with a wall or its image, or if a node of finite
///         elements or bars that moves with the grid is not in small cells
void watch_levels(State& state);

/// Ends the run on every rank if there is a mixed particle where functions of one level are required. Collective.
/// @param particle  of this rank; `not_mixed`: none
/// @param what      happens there
void stop_at_mixed(const State& state, std::uint32_t particle, const std::string& what);

}  // namespace whipple::solver

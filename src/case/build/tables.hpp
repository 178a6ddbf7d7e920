// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/case.hpp"
#include "src/io/ranks.hpp"

namespace whipple::cases {

/// Replaces the models of the bodies with equation_of_state = "table" by tables of them, read from the user's cache, or
/// built by the root with all its threads and added to the cache. Collective. The reference state becomes that of the
/// table.
/// @throws InputError naming the body if its model cannot be tabulated
void tabulate_materials(Case& setup, const io::Ranks& ranks);

}  // namespace whipple::cases

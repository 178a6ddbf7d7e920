// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/catalogue.hpp"
#include "src/material/reaction/reaction.hpp"

namespace whipple::reaction {

using ReactionEntry = CatalogueEntry<const Reaction>;

/// Returns all rate laws of explosives.
const Catalogue<ReactionEntry>& catalogue();

}  // namespace whipple::reaction

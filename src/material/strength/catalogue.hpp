// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/catalogue.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

using ModelEntry = CatalogueEntry<const Strength>;
/// Returns all strength models.
const Catalogue<ModelEntry>& catalogue();

}  // namespace whipple::strength

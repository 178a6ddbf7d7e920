// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/core/base/catalogue.hpp"
#include "src/material/constitutive.hpp"

namespace whipple::material {

/// Describes a constitutive model that replaces strength and failure.
struct ConstitutiveEntry : CatalogueEntry<const Constitutive> {
  std::vector<HistoryField> fields;  ///< fields that it declares
};
/// Returns all constitutive models of the catalogue.
const Catalogue<ConstitutiveEntry>& catalogue();

/// Returns every field that any constitutive model may declare, for checkpoints and output by name.
const std::vector<HistoryField>& history_fields();

}  // namespace whipple::material

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/core/base/catalogue.hpp"
#include "src/material/constitutive.hpp"

namespace whipple::material {

/// A constitutive model that takes the place of strength and failure.
struct ConstitutiveEntry : CatalogueEntry<const Constitutive> {
  std::vector<HistoryField> fields;  ///< that it declares
};
/// All of them, one line each.
const Catalogue<ConstitutiveEntry>& catalogue();

/// Every field that some constitutive model may declare: by name for checkpoints and output.
const std::vector<HistoryField>& history_fields();

}  // namespace whipple::material

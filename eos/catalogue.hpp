// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "eos/equation_of_state.hpp"
#include "src/core/base/catalogue.hpp"

/// Lists all equations of state that a material can name. A new model is one line of catalogue.cpp.
namespace whipple::eos {

using ModelEntry = CatalogueEntry<EquationOfState>;
const Catalogue<ModelEntry>& catalogue();

/// Describes a modifier of an equation of state (`[[eos.modifier]]` of a material file, applied in order); its
/// builder takes the modified equation of state.
using ModifierEntry = CatalogueEntry<EquationOfState, std::shared_ptr<const EquationOfState>>;
const Catalogue<ModifierEntry>& modifier_catalogue();

}  // namespace whipple::eos

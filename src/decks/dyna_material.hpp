// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "src/decks/dyna_deck.hpp"
#include "src/decks/report.hpp"
#include "src/decks/unit_system.hpp"

namespace whipple::decks::dyna {

struct CaseMaterial {
  std::string file;      ///< "materials/part_1.toml"
  double density = 0.0;  ///< in the units of the deck
  bool explosive = false;
  double initial_pressure = 0.0;  ///< of an initial energy in Mie-Grueneisen, in the units of the deck
};

/// Returns whether the library has the law of a *MAT.
bool has_law(const Block& material);

/// Builds the material file of a part from its *MAT and, where it has one, its *EOS, with remarks upon both.
/// @throws InputError for constants that are blank and needed, or that no material has
CaseMaterial material_of(const Deck& deck, const Block& material, const Block* state, const std::string& name,
                         const UnitSystem& units, Import& import);

}  // namespace whipple::decks::dyna

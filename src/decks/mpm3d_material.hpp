// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "src/decks/mpm3d_deck.hpp"
#include "src/decks/report.hpp"

namespace whipple::decks::mpm3d {

/// Describes a material of a deck as a material file.
struct CaseMaterial {
  std::string file;               ///< "materials/material_1.toml"
  double density = 0.0;           ///< in the units of the deck
  double initial_pressure = 0.0;  ///< due to an initial energy in Mie-Grueneisen; in the units of the deck
  bool explosive = false;
};

/// Builds the material files of a deck, by number, with remarks on every `mate` and `seos`.
/// @throws InputError for impossible constants, and for equations of state of undefined materials
std::map<int, CaseMaterial> materials_of(const Deck& deck, const UnitSystem& units, Import& import);

}  // namespace whipple::decks::mpm3d

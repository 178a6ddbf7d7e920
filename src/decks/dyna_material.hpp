// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "src/decks/dyna_deck.hpp"
#include "src/decks/import.hpp"
#include "src/decks/report.hpp"
#include "src/decks/unit_system.hpp"

namespace whipple::decks::dyna {

struct CaseMaterial {
  std::string file;      ///< "materials/part_1.toml"
  double density = 0.0;  ///< in the units of the deck
  bool explosive = false;
  bool fails = false;                ///< can lose its strength permanently
  bool fluid = false;                ///< has no strength
  double detonation_velocity = 0.0;  ///< of an explosive, in the units of the deck
  double burn = 0.0;                 ///< BETA of an explosive: 0 time and compression, 1 compression, 2 time
  double initial_pressure = 0.0;     ///< due to an initial energy, in the units of the deck; 0: not given
  double initial_density = 0.0;      ///< at that pressure
};

/// Returns whether the library has the law of a *MAT.
bool has_law(const Block& material);

/// Builds the material file of a part from its *MAT and, if it has one, its *EOS, with remarks on both.
/// @throws InputError for required constants that are blank, and for impossible values
CaseMaterial material_of(const Deck& deck, const Block& material, const Block* state, const std::string& name,
                         const UnitSystem& units, Triaxiality triaxiality, Import& import);

}  // namespace whipple::decks::dyna

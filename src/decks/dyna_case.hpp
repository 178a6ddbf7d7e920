// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/decks/dyna_deck.hpp"
#include "src/decks/import.hpp"

namespace whipple::decks::dyna {

/// Turns a deck into a case with its material files and meshes. Every keyword gets a remark; those that are not read
/// are missing, by name and number.
/// @throws InputError with all faults: cards that cannot be read, references to what the deck does not define, units or
///         cell size not given
Import to_case(const Deck& deck, const ImportOptions& options);

}  // namespace whipple::decks::dyna

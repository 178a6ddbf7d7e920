// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/decks/dyna_deck.hpp"
#include "src/decks/import.hpp"

namespace whipple::decks::dyna {

/// Converts a deck to a case with its material files and meshes. Every keyword gets a remark; keywords that are not
/// read are reported as missing, by name and number.
/// @throws InputError with all faults: unreadable cards, references to undefined items, missing units or cell size
Import to_case(const Deck& deck, const ImportOptions& options);

}  // namespace whipple::decks::dyna

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/decks/import.hpp"
#include "src/decks/mpm3d_deck.hpp"

namespace whipple::decks::mpm3d {

/// Converts a deck to a case with its material files; every statement gets a remark.
/// @throws InputError with all faults: impossible values, missing statements that a case requires, units that are
/// neither in a comment of the deck nor among the options
Import to_case(const Deck& deck, const ImportOptions& options);

}  // namespace whipple::decks::mpm3d

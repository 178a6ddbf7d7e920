// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/tensor.hpp"
#include "src/decks/mpm3d_deck.hpp"
#include "src/decks/report.hpp"

namespace whipple::decks::mpm3d {

/// Holds the box of the grid, in the length unit of the deck.
struct GridOfDeck {
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();
  unsigned line = 0;  ///< line of the last statement that defines part of it
};

/// Reads the corners of the grid, with remarks on their statements: if `grid` and the three spans are both given, the
/// later one is used.
GridOfDeck grid_of(const Deck& deck, Import& import);

}  // namespace whipple::decks::mpm3d

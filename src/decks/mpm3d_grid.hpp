// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/tensor.hpp"
#include "src/decks/mpm3d_deck.hpp"
#include "src/decks/report.hpp"

namespace whipple::decks::mpm3d {

/// The box of the grid, in the length of the deck.
struct GridOfDeck {
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();
  unsigned line = 0;  ///< of the last statement that gave a part of it
};

/// Reads the corners of the grid and remarks upon their statements: of `grid` and the three spans the later one counts.
GridOfDeck grid_of(const Deck& deck, Import& import);

}  // namespace whipple::decks::mpm3d

// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/mpm3d_grid.hpp"

#include <vector>

namespace whipple::decks::mpm3d {

GridOfDeck grid_of(const Deck& deck, Import& import) {
  GridOfDeck grid;
  for (const Statement& statement : deck.statements) {
    const std::vector<double>& n = statement.numbers;
    switch (statement.keyword) {
      case Keyword::grid:
        grid.lower = Vector3(n[0], n[2], n[4]);
        grid.upper = Vector3(n[1], n[3], n[5]);
        break;
      case Keyword::span_x:
      case Keyword::span_y:
      case Keyword::span_z: {
        const int axis = static_cast<int>(statement.keyword) - static_cast<int>(Keyword::span_x);
        grid.lower[axis] = n[0];
        grid.upper[axis] = n[1];
        break;
      }
      default:
        continue;
    }
    grid.line = statement.line;
    import.remark(Outcome::exact, statement.line, statement.name(), "domain");
  }
  return grid;
}

}  // namespace whipple::decks::mpm3d

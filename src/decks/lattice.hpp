// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/core/base/tensor.hpp"

namespace whipple::decks {

struct LatticeBox {
  Vector3 lower, upper;
};

/// Finds boxes that together are the cells of a cubic lattice with one point in each cell.
/// @param spacing  edge of the cells, accurate to one per cent
/// @param most     maximum number of boxes
/// @returns boxes that cover each cell exactly once; nothing if the points are not on such a lattice, if two are in one
/// cell, or if more boxes are needed
std::optional<std::vector<LatticeBox>> boxes_of_points(std::span<const Vector3> points, double spacing,
                                                       std::size_t most);

}  // namespace whipple::decks

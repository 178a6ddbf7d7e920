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

/// Finds the boxes that together are the cells of a cubic lattice with a point in each of them.
/// @param spacing  edge of the cells, to a per cent
/// @param most     boxes
/// @returns boxes that neither overlap nor leave out a cell; nothing if the points are on no such lattice, if two are in
///          one cell, or if it takes more boxes
std::optional<std::vector<LatticeBox>> boxes_of_points(std::span<const Vector3> points, double spacing,
                                                       std::size_t most);

}  // namespace whipple::decks

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/core/base/tensor.hpp"

namespace whipple::decks::dyna {

/// Encodes the directions in which a node is constrained: 1 for x, 2 for y, 4 for z.
using Directions = std::uint8_t;
inline constexpr Directions along(int axis) {
  return static_cast<Directions>(1U << static_cast<unsigned>(axis));
}

/// Holds a part with its constrained nodes.
struct HeldPart {
  std::vector<Vector3> nodes;
  std::vector<Directions> held;                              ///< of every node
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();  ///< corners of the part
  double shortest_edge = 0.0;
};

/// Describes a face of the domain that is a symmetry plane.
struct Mirror {
  int axis = 0;
  bool at_upper = false;
  double place = 0.0;
};

/// Finds the symmetry planes: the planes at the border of all parts where every node is constrained along the normal,
/// and most of them only by such planes. Removes the constraints of these planes from the parts.
/// @param cell  edge of the cells of the grid: two opposite planes must be a whole number of cells apart, otherwise
/// only the lower one is used
std::vector<Mirror> take_mirrors(std::vector<HeldPart>& parts, double cell);

/// Holds an axis-parallel box with the constraints of the nodes in it.
struct NodeBox {
  Vector3 lower, upper;
  Directions directions = 0;
};

/// Returns boxes that contain all constrained nodes of a part and no others; nothing if that needs more than `most`
/// boxes, or if a constrained node coincides with a free one.
std::optional<std::vector<NodeBox>> boxes_of_held_nodes(const HeldPart& part, std::size_t most);

}  // namespace whipple::decks::dyna

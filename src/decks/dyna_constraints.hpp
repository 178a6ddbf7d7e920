// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/core/base/tensor.hpp"

namespace whipple::decks::dyna {

/// Directions in which a node is held: 1 for x, 2 for y, 4 for z.
using Directions = std::uint8_t;
inline constexpr Directions along(int axis) {
  return static_cast<Directions>(1U << static_cast<unsigned>(axis));
}

/// A part with the nodes of it that are held.
struct HeldPart {
  std::vector<Vector3> nodes;
  std::vector<Directions> held;                              ///< of every node
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();  ///< corners of the part
  double shortest_edge = 0.0;
};

/// A face of the domain at which bodies are mirrored.
struct Mirror {
  int axis = 0;
  bool at_upper = false;
  double place = 0.0;
};

/// Finds the planes at the border of all parts where every node is held along the normal, and most of them no further: they
/// are planes of symmetry. Takes from the parts what these planes hold.
/// @param cell  edge of the cells of the grid: between two planes there must be whole cells, else only the lower one counts
std::vector<Mirror> take_mirrors(std::vector<HeldPart>& parts, double cell);

/// A box along the axes with the nodes that are held in it.
struct NodeBox {
  Vector3 lower, upper;
  Directions directions = 0;
};

/// Returns boxes that contain the nodes of a part that are held, and no others; nothing if that takes more than `most`
/// of them, or if a node that is held lies where another one is free.
std::optional<std::vector<NodeBox>> boxes_of_held_nodes(const HeldPart& part, std::size_t most);

}  // namespace whipple::decks::dyna

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/decks/dyna_model.hpp"

namespace whipple::decks::dyna {

/// Holds the solid elements of a part as a Gmsh mesh.
struct PartMesh {
  std::string text;                                ///< the file, format 2.2
  double volume = 0.0;                             ///< in the units of the deck, like all values below
  double longest_edge = 0.0, shortest_edge = 0.0;  ///< mean edges of elements
  unsigned odd_line = 0;  ///< line of the first element that is not a hexahedron; 0: none
};

/// Returns the position of a node.
/// @throws InputError if there is no such node
const Vector3& place_of(const Model& model, const Part& part, Id node);

/// Returns the numbers of the nodes of a part, in ascending order.
std::vector<Id> nodes_of(const Part& part);

PartMesh mesh_of(const Model& model, const Part& part);

}  // namespace whipple::decks::dyna

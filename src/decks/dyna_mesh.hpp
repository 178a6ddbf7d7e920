// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/decks/dyna_model.hpp"

namespace whipple::decks::dyna {

/// Solid elements of a part as a mesh of Gmsh.
struct PartMesh {
  std::string text;                                ///< the file, format 2.2
  double volume = 0.0;                             ///< in the units of the deck, as all below
  double longest_edge = 0.0, shortest_edge = 0.0;  ///< mean edges of elements
  unsigned odd_line = 0;  ///< of the first element that is no hexahedron; 0: there is none
};

/// Returns the place of a node.
/// @throws InputError if there is none
const Vector3& place_of(const Model& model, const Part& part, Id node);

/// Returns the numbers of the nodes of a part, in their order.
std::vector<Id> nodes_of(const Part& part);

PartMesh mesh_of(const Model& model, const Part& part);

}  // namespace whipple::decks::dyna

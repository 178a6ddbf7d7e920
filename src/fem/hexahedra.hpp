// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/core/base/vector_math.hpp"

/// Eight-node hexahedra as created by generators and read from files (docs/theory/fem.md).
namespace whipple::fem {

/// Holds the node indices of a hexahedron in the order of VTK (type 12) and Gmsh (type 5): natural coordinates (-,-,-)
/// (+,-,-) (+,+,-) (-,+,-), then the same four with zeta = +1.
using Corners = std::array<std::uint32_t, 8>;

/// Holds points and hexahedra only: the result of generators and readers.
struct Hexahedra {
  std::vector<Vector3> nodes;  ///< m
  std::vector<Corners> elements;
};

/// Describes an invalid element (counted from 0) and the reason: a node that does not exist, a repeated corner
/// (degenerate), a non-positive Jacobian at a corner or Gauss point (inverted).
struct Fault {
  std::size_t element;
  std::string reason;
};
std::optional<Fault> first_fault(const Hexahedra& hexahedra);

/// Returns the volume, m^3.
double volume(const Hexahedra& hexahedra);

/// Checks a mesh.
/// @param name  of the mesh, prefix of the message
/// @throws InputError for the first fault, for a mesh without elements, for nodes without elements
void check(const Hexahedra& hexahedra, const std::string& name);

}  // namespace whipple::fem

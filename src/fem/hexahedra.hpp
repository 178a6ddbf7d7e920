// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/core/base/vector_math.hpp"

/// Eight-node hexahedra as generators make and readers read them (docs/theory/fem.md).
namespace whipple::fem {

/// Indices of the nodes of a hexahedron in the order of VTK (type 12) and Gmsh (type 5): natural coordinates
/// (-,-,-) (+,-,-) (+,+,-) (-,+,-), then the same four with zeta = +1.
using Corners = std::array<std::uint32_t, 8>;

/// Points and hexahedra, nothing else: what generators make and readers read.
struct Hexahedra {
  std::vector<Vector3> nodes;  ///< m
  std::vector<Corners> elements;
};

/// The first element (counted from 0) that cannot be computed with, and why: a node that does not exist, a
/// corner used twice (degenerate), a Jacobian that is not positive in a corner or Gauss point (inverted).
struct Fault {
  std::size_t element;
  std::string reason;
};
std::optional<Fault> first_fault(const Hexahedra& hexahedra);

/// m^3
double volume(const Hexahedra& hexahedra);

/// @param name  of the mesh, begins the message
/// @throws InputError for the first fault, for a mesh without elements, for nodes of no element
void check(const Hexahedra& hexahedra, const std::string& name);

}  // namespace whipple::fem

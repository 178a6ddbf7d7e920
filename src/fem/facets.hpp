// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/fem/mesh.hpp"

namespace whipple::fem {

/// Nodes of a face of a hexahedron; they go round its outward normal.
using Facet = std::array<std::uint32_t, 4>;

/// Faces that belong to one element only: the surface of a mesh, in the order of the elements.
/// The mesh must be connected (`connect`).
/// @param marked  empty, or of each node whether it may be on the surface (!= 0): faces of other nodes are
/// not
///                looked at
std::vector<Facet> surface_facets(const Mesh& mesh, std::span<const std::uint8_t> marked = {});

}  // namespace whipple::fem

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
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

/// Two elements on the same side of a common face: they lie in one another.
struct Overlap {
  std::size_t element, other;
  bool same;  ///< all eight nodes are the same
};
/// The first pair of elements that overlap, by common nodes. Where there is none, the elements fill the
/// volume that the surface of the mesh bounds.
std::optional<Overlap> first_overlap(const Hexahedra& hexahedra);

}  // namespace whipple::fem

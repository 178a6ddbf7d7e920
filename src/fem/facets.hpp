// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "src/fem/mesh.hpp"

namespace whipple::fem {

/// Holds the nodes of a face of a hexahedron, counter-clockwise about its outward normal. An edge of a quadrilateral,
/// from a to b counter-clockwise, is (a, b, b, a).
using Facet = std::array<std::uint32_t, 4>;

/// Returns the faces that belong to one element only, the surface of a mesh, in the order of the elements. The mesh
/// must be connected (`connect`).
/// @param marked  empty, or nonzero for each node that may be on the surface: faces with other nodes are skipped
std::vector<Facet> surface_facets(const Mesh& mesh, std::span<const std::uint8_t> marked = {});

/// Describes two elements on the same side of a common face, which therefore overlap.
struct Overlap {
  std::size_t element, other;
  bool same;  ///< all eight nodes are identical
};
/// Finds the first pair of elements that overlap, judged by common nodes. Without such a pair, the elements fill the
/// volume bounded by the surface of the mesh.
std::optional<Overlap> first_overlap(const Hexahedra& hexahedra);

}  // namespace whipple::fem

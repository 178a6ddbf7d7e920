// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/fem/facets.hpp"
#include "src/grid/block_grid.hpp"

namespace whipple::contact {

/// Points on the surfaces of bodies of elements, which stand for the facets around them
/// (docs/theory/contact.md, eq. 3.6).
struct SurfacePoints {
  std::vector<Vector3> position;  ///< m
  std::vector<Vector3> area;  ///< m^2, integral of the outward normal over the point's part of the surface
  std::vector<double> size;   ///< m^2, of that part
  std::vector<std::uint8_t> field;  ///< velocity field of the body

  [[nodiscard]] std::size_t count() const { return position.size(); }
  void clear();

  /// Adds the surface of a body: its nodes, and further points so that none are more than `spacing` (m)
  /// apart.
  void add(const fem::Mesh& mesh, std::span<const fem::Facet> facets, std::uint8_t field, double spacing);
};

/// Surface points by block, as the grid stands.
struct PlacedPoints {
  const SurfacePoints* points = nullptr;
  grid::PointList in_slot;
  std::array<std::vector<std::uint32_t>, 8> colours;  ///< slots with points whose reaches do not overlap

  /// Those near contact slots; the others are left out.
  PlacedPoints(const SurfacePoints& surface, const grid::BlockGrid& grid);
};

}  // namespace whipple::contact

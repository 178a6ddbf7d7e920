// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/fem/facets.hpp"
#include "src/grid/block_grid.hpp"
#include "src/grid/block_table.hpp"

namespace whipple::contact {

/// The blocks from which points reach contact slots of the grid of this rank.
class BlocksAtContact {
 public:
  explicit BlocksAtContact(const grid::BlockGrid& grid);
  /// Returns whether the points intersect a box (m).
  [[nodiscard]] bool meet(const Vector3& lower, const Vector3& upper) const;

 private:
  const grid::Geometry& geometry_;
  grid::BlockTable blocks_;
};

/// Points on the surfaces of bodies of elements, which stand for the facets around them
/// (docs/theory/contact.md, eq. 3.6).
struct SurfacePoints {
  std::vector<Vector3> position;  ///< m
  std::vector<Vector3> area;  ///< m^2, integral of the outward normal over the point's part of the surface
  std::vector<double> size;   ///< m^2, of that part
  std::vector<std::uint8_t> field;  ///< velocity field of the body
  std::vector<std::uint64_t> node;  ///< id of the node that the point is, or `no_node`

  static constexpr std::uint64_t no_node = static_cast<std::uint64_t>(-1);
  [[nodiscard]] std::size_t count() const { return position.size(); }
  void clear();

  /// Adds the surface of a body: its nodes, and further points so that none are more than `spacing` (m)
  /// apart.
  /// @param near  facets that do not meet it are left out; null: all are added
  void add(const fem::Mesh& mesh, std::span<const fem::Facet> facets, std::uint8_t field, double spacing,
           const BlocksAtContact* near);

  /// Sends every point to the ranks that own grid nodes which it reaches; those of several ranks that are one
  /// node of a mesh become one. Collective.
  void send_to_owners(const grid::BlockGrid& grid, grid::Stencil stencil, MPI_Comm communicator);

 private:
  static constexpr std::uint32_t no_point = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> point_of_node_;  // of a mesh: scratch of `add`, `no_point` between its calls
};

/// Surface points by block, as the grid stands: those that reach contact slots of this rank. Their own blocks
/// need not be active.
struct PlacedPoints {
  struct Block {
    grid::BlockCoordinate coordinate;
    std::array<std::int32_t, 27> slots;  ///< around it and own: those of this rank's contact slots only
    std::vector<std::uint32_t> points;
  };
  const SurfacePoints* points = nullptr;
  std::vector<Block> blocks;
  std::array<std::vector<std::uint32_t>, 8> colours;  ///< blocks whose points' reaches do not overlap

  PlacedPoints(const SurfacePoints& surface, const grid::BlockGrid& grid);
};

}  // namespace whipple::contact

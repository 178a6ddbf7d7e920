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

/// Finds the blocks from which points reach contact slots of this rank.
class BlocksAtContact {
 public:
  explicit BlocksAtContact(const grid::BlockGrid& grid);
  /// Returns whether any of these blocks intersects a box (m).
  [[nodiscard]] bool meet(const Vector3& lower, const Vector3& upper) const;

 private:
  const grid::Geometry& geometry_;
  grid::BlockTable blocks_;
};

/// Holds the points on the surfaces of element bodies that represent the adjacent facets (docs/theory/contact.md,
/// equation 3.6).
struct SurfacePoints {
  std::vector<Vector3> position;  ///< m
  std::vector<Vector3> area;  ///< m^2, integral of the outward normal over the point's part of the surface
  std::vector<double> size;   ///< area of that part, m^2
  std::vector<std::uint8_t> field;  ///< velocity field of the body
  std::vector<std::uint64_t> node;  ///< id of the mesh node at the point, or `no_node`

  static constexpr std::uint64_t no_node = static_cast<std::uint64_t>(-1);
  [[nodiscard]] std::size_t count() const { return position.size(); }
  void clear();

  /// Adds the surface of a body: its nodes and intermediate points, so that adjacent points are at most `spacing` (m)
  /// apart.
  /// @param near  facets outside these blocks are skipped; null: all facets are added
  void add(const fem::Mesh& mesh, std::span<const fem::Facet> facets, std::uint8_t field, double spacing,
           const BlocksAtContact* near);

  /// Sends each point to the ranks that own grid nodes within its reach; points from several ranks that belong to one
  /// mesh node are combined. Collective.
  void send_to_owners(const grid::BlockGrid& grid, grid::Stencil stencil, MPI_Comm communicator);

 private:
  static constexpr std::uint32_t no_point = static_cast<std::uint32_t>(-1);
  // Of a mesh: scratch of `add`, reset to `no_point` after each call
  std::vector<std::uint32_t> point_of_node_;
};

/// Lists the surface points that reach contact slots of this rank by block, for the present grid. Their own blocks need
/// not be active.
struct PlacedPoints {
  struct Block {
    grid::BlockCoordinate coordinate;
    std::array<std::int32_t, 27> slots;  ///< of the 27 blocks, restricted to this rank's contact slots
    std::vector<std::uint32_t> points;
  };
  const SurfacePoints* points = nullptr;
  std::vector<Block> blocks;
  std::array<std::vector<std::uint32_t>, 8> colours;  ///< blocks whose points have disjoint reaches

  PlacedPoints(const SurfacePoints& surface, const grid::BlockGrid& grid);
};

}  // namespace whipple::contact

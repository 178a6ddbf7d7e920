// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "src/core/base/simd.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/grid/geometry.hpp"

/// Nodes that a point reaches, and those that the points of a block reach together.
namespace whipple::grid {

/// Returns the edge of the largest region of nodes that the points of a block reach: one node before the block, those
/// of the block, two after it.
constexpr int reach_edge(int block_edge) { return block_edge + 3; }
constexpr int longest_reach_edge = reach_edge(block_shape(true).edge);

/// Describes the nodes that a kernel reaches from a particle: `count` nodes per direction, the first at floor(X -
/// shift), where X is the position in cells. In two dimensions one node along z, in the plane z = lower.
struct Stencil {
  double shift = 0.5;
  int count = 3;
  bool planar = false;

  /// Return the number of nodes before a block that its points reach, and the edge of the region that they reach.
  [[nodiscard]] constexpr BlockShape block() const { return block_shape(planar); }
  [[nodiscard]] constexpr int before() const { return shift > 0.0 ? 1 : 0; }
  [[nodiscard]] constexpr int edge() const {
    return before() == 0 ? block().edge + 1 : reach_edge(block().edge);
  }
  /// Return the same along z.
  [[nodiscard]] constexpr int before_z() const { return planar ? 0 : before(); }
  [[nodiscard]] constexpr int edge_z() const { return planar ? 1 : edge(); }
  [[nodiscard]] constexpr int nodes_reached() const { return edge() * edge() * edge_z(); }
};

/// Returns the lower corner of a block, in cells.
inline Lanes corner_of(const BlockCoordinate& block, BlockShape shape) {
  return Lanes{static_cast<double>(shape.edge * block[0]), static_cast<double>(shape.edge * block[1]),
               static_cast<double>(shape.edge_z * block[2]), 0.0};
}
/// Returns whether a position, in cells from the lower corner of a block, is inside it.
/// @param edges  edges of the block (BlockShape::edges)
inline bool is_inside(Lanes local, Lanes edges) {
  return bits((local >= 0.0) & (local < edges)) == all_lanes;
}
/// Returns a position in cells from the lower corner of its block, smaller than the edges of the block: for a position
/// just below a corner at zero, the difference may be rounded up.
inline Lanes position_in_block(Lanes in_cells, Lanes corner, Lanes edges) {
  constexpr double below_end = 1.0 - std::numeric_limits<double>::epsilon();
  return minimum(in_cells - corner, below_end * edges);
}

/// Maps a node of the largest region, per direction, to the offset of the block that owns it (0 before, 1 same, 2
/// after) and its index inside that block. Position 0 is the node before the block's first node.
struct ReachMap {
  std::array<int, longest_reach_edge> block{};
  std::array<int, longest_reach_edge> node{};
};
/// Returns the map of a direction.
/// @param block_edge  edge of the block along the direction
constexpr ReachMap reach_map(int block_edge) {
  ReachMap map;
  for (int i = 0; i < reach_edge(block_edge); ++i) {
    const int shifted = i - 1 + block_edge;
    map.block[static_cast<std::size_t>(i)] = shifted / block_edge;
    map.node[static_cast<std::size_t>(i)] = shifted % block_edge;
  }
  return map;
}

/// Holds the position of a point relative to the nodes of its stencil.
class PlaceInStencil {
 public:
  /// Returns the position in cells from the first node; lane 3 is not a position.
  [[nodiscard]] Lanes from_first() const { return lanes_; }
  /// Returns the distance from the first node along one direction.
  [[nodiscard]] double from_first(std::size_t direction) const {
    return reinterpret_cast<const double*>(&lanes_)[direction];
  }
  /// Returns the number of the first node among those that the points of the block reach, z fastest.
  [[nodiscard]] std::int32_t first_node() const {
    static_assert(std::endian::native == std::endian::little);
    std::int32_t low;
    __builtin_memcpy(&low, reinterpret_cast<const double*>(&lanes_) + 3, sizeof(low));
    return low;
  }
  /// Returns the first node along y, counted from the lower corner of the block, for a planar stencil.
  [[nodiscard]] int first_node_along_y_in_plane(Stencil stencil) const {
    constexpr int edge = block_shape(true).edge;  // of the block: a divisor known to the compiler
    return stencil.before() == 0 ? first_node() % (edge + 1) : first_node() % reach_edge(edge) - 1;
  }
  /// Returns the first node counted from the lower corner of the block, by direction.
  [[nodiscard]] WHIPPLE_INLINE std::array<int, 3> first_node(Stencil stencil) const {
    const int edge = stencil.edge(), edge_z = stencil.edge_z(), before = stencil.before(),
              first = first_node();
    return {first / (edge * edge_z) - before, first / edge_z % edge - before,
            first % edge_z - stencil.before_z()};
  }

 private:
  friend class StencilPlaces;
  Lanes lanes_;  ///< the low bits of lane 3 are those of the first node's number
};

/// Computes positions in a stencil of a given kind.
class StencilPlaces {
 public:
  WHIPPLE_INLINE explicit StencilPlaces(Stencil stencil) : shift_(broadcast(stencil.shift)) {
    const double edge = stencil.edge(), edge_z = stencil.edge_z();
    strides_ = Lanes{edge * edge_z, edge_z, stencil.planar ? 0.0 : 1.0, 0.0};
    origin_ = Lanes{integer, 0.0, 0.0, 0.0} + stencil.before() * strides_;
  }
  /// Returns the first node of the stencil, in cells like `local`.
  /// @param local  position in cells from the block's lower corner, inside the block
  [[nodiscard]] Lanes first_node(Lanes local) const { return floor(local - shift_); }
  [[nodiscard]] WHIPPLE_INLINE PlaceInStencil operator()(Lanes local) const {
    return at(local, first_node(local));
  }
  /// Returns the position of a point in its stencil.
  /// @param first  result of `first_node`
  [[nodiscard]] WHIPPLE_INLINE PlaceInStencil at(Lanes local, Lanes first) const {
    const Lanes parts = multiply_add(first, strides_, origin_);
    const Lanes pairs = parts + __builtin_shufflevector(parts, parts, 2, 3, 0, 1);
    const Lanes sum = pairs + __builtin_shufflevector(pairs, pairs, 1, 0, 3, 2);
    PlaceInStencil place;
    place.lanes_ = __builtin_shufflevector(local - first, sum, 0, 1, 2, 7);
    return place;
  }

 private:
  /// The low bits of 2^52 + i are those of the integer i: no conversion is required, and every lane holds a normal
  /// number, on which arithmetic is fast.
  static constexpr double integer = 4503599627370496.0;
  Lanes shift_, strides_, origin_;
};

}  // namespace whipple::grid

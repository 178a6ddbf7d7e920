// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "src/grid/block_grid.hpp"

/// Two ways to the nodes that the particles of a block reach. Full blocks work on a copy of the 7x7x7 nodes
/// in the first-level cache, so the kernel's addresses are affine; nearly empty blocks go to the nodes
/// directly, so that a lone particle does not pay for 343 nodes.
namespace whipple::transfer {

/// Blocks with fewer particles than this use direct access.
constexpr std::size_t direct_access_below = 6;

/// Copy of the nodes that a block reaches; index = position in the reach, z fastest.
class ReachCopy {
 public:
  static constexpr int edge = grid::reach_edge;
  static constexpr int size = edge * edge * edge;

  /// The node at (x, y, z), counted from the block's lower corner (>= -1).
  grid::Node* node(int x, int y, int z) { return &nodes_[index(x + 1, y + 1, z + 1)]; }

  void clear() {
    for (grid::Node& node : nodes_) node = {broadcast(0.0), broadcast(0.0)};
  }
  void load(const grid::BlockGrid& grid, std::size_t slot) {
    for_each_owner(grid, slot, [&](const grid::Node* owner, int in_block, std::size_t here) {
      nodes_[here] = owner[in_block];
    });
  }
  /// Adds the copy to the grid. Blocks of one colour do not overlap, so no two threads meet here.
  void add_to(grid::BlockGrid& grid, std::size_t slot) const {
    for_each_owner(grid, slot, [&](grid::Node* owner, int in_block, std::size_t here) {
      owner[in_block].first += nodes_[here].first;
      owner[in_block].second += nodes_[here].second;
    });
  }

 private:
  static std::size_t index(int x, int y, int z) {
    return static_cast<std::size_t>((x * edge + y) * edge + z);
  }

  /// Calls f(nodes of the owning block, index in it, index here) for every node of the reach whose block is
  /// active; no particle reaches the others.
  template <class Grid, class Function>
  static void for_each_owner(Grid& grid, std::size_t slot, Function&& f) {
    static constexpr grid::ReachMap map = grid::reach_map();
    const auto& neighbours = grid.neighbours(slot);
    for (int x = 0; x < edge; ++x) {
      for (int y = 0; y < edge; ++y) {
        for (int zb = 0, z = 0; zb < 3; ++zb) {
          const int last = zb == 0 ? 1 : zb == 1 ? 1 + grid::block_edge : edge;
          const auto ux = static_cast<std::size_t>(x);
          const auto uy = static_cast<std::size_t>(y);
          const std::int32_t owner =
              neighbours[static_cast<std::size_t>(grid::neighbour_index(map.block[ux], map.block[uy], zb))];
          if (owner == grid::BlockGrid::no_slot) {
            z = last;
            continue;
          }
          auto* nodes = grid.nodes(static_cast<std::size_t>(owner));
          const int row = grid::node_index(map.node[ux], map.node[uy], 0);
          for (; z < last; ++z) f(nodes, row + map.node[static_cast<std::size_t>(z)], index(x, y, z));
        }
      }
    }
  }

  std::array<grid::Node, size> nodes_;
};

/// The nodes of the grid themselves, each found through the neighbours of the block.
class DirectAccess {
 public:
  DirectAccess(grid::BlockGrid& grid, std::size_t slot) : grid_(grid), neighbours_(grid.neighbours(slot)) {}

  grid::Node* node(int x, int y, int z) {
    static constexpr grid::ReachMap map = grid::reach_map();
    const auto ux = static_cast<std::size_t>(x + 1);
    const auto uy = static_cast<std::size_t>(y + 1);
    const auto uz = static_cast<std::size_t>(z + 1);
    const std::int32_t owner = neighbours_[static_cast<std::size_t>(
        grid::neighbour_index(map.block[ux], map.block[uy], map.block[uz]))];
    return grid_.nodes(static_cast<std::size_t>(owner)) +
           grid::node_index(map.node[ux], map.node[uy], map.node[uz]);
  }

 private:
  grid::BlockGrid& grid_;
  const std::array<std::int32_t, 27>& neighbours_;
};

}  // namespace whipple::transfer

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "src/grid/block_grid.hpp"

/// Two ways to the nodes that the particles of a block reach. Full blocks work on a copy of these nodes in
/// the first-level cache, so the kernel's addresses are affine; nearly empty blocks go to the nodes directly,
/// so that a lone particle does not pay for 343 nodes. Both give the nodes of one particle as an object that
/// is called with the number of the node in each direction. At contact slots the nodes are those of one
/// velocity field.
namespace whipple::transfer {

/// Blocks with fewer particles than this use direct access.
constexpr std::size_t direct_access_below = 6;

/// What a copy holds of a node: all of it, or only the first register.
inline void copy_node(const grid::Node& from, grid::Node& to) { to = from; }
inline void copy_node(const grid::Node& from, Lanes& to) { to = from.first; }
inline void add_node(const grid::Node& from, grid::Node& to) {
  to.first += from.first;
  to.second += from.second;
}
inline void add_node(Lanes from, grid::Node& to) { to.first += from; }
inline Lanes& first_register(grid::Node& node) { return node.first; }
inline Lanes& first_register(Lanes& first) { return first; }

/// Copy of the nodes that a block reaches; index = position in the reach, z fastest.
/// @tparam Shape    its stencil gives the reach
/// @tparam Content  what is copied: grid::Node, or Lanes for Node::first
template <class Shape, class Content = grid::Node>
class ReachCopy {
 public:
  static constexpr int before = Shape::stencil.shift > 0.0 ? 1 : 0;  ///< nodes before the block
  static constexpr int edge = before == 0 ? grid::block_edge + 1 : grid::reach_edge;
  static constexpr int size = edge * edge * edge;
  static_assert(Shape::stencil.count <= edge - grid::block_edge + 1);

  /// The nodes of one particle.
  struct Stencil {
    Content* origin;
    Content& operator()(std::size_t i, std::size_t j, std::size_t k) const {
      return origin[(i * edge + j) * edge + k];
    }
  };
  /// From the first node, counted from the block's lower corner.
  Stencil stencil(const std::array<int, 3>& first) {
    return {&nodes_[index(first[0] + before, first[1] + before, first[2] + before)]};
  }

  void clear() {
    for (Content& node : nodes_) node = Content{};
  }
  void load(const grid::BlockGrid& grid, std::size_t slot, unsigned field) {
    for_each_owner(grid, slot, field, [&](const grid::Node* owner, int in_block, std::size_t here) {
      copy_node(owner[in_block], nodes_[here]);
    });
  }
  /// Adds the copy to the grid. Blocks of one colour do not overlap, so no two threads meet here.
  void add_to(grid::BlockGrid& grid, std::size_t slot, unsigned field) const {
    for_each_owner(grid, slot, field, [&](grid::Node* owner, int in_block, std::size_t here) {
      add_node(nodes_[here], owner[in_block]);
    });
  }

 private:
  static std::size_t index(int x, int y, int z) {
    return static_cast<std::size_t>((x * edge + y) * edge + z);
  }

  /// Calls f(nodes of the owning block, index in it, index here) for every node of the reach whose block is
  /// active; no particle reaches the others.
  template <class Grid, class Function>
  static void for_each_owner(Grid& grid, std::size_t slot, unsigned field, Function&& f) {
    static constexpr grid::ReachMap map = grid::reach_map();
    constexpr int skipped = 1 - before;  // the map begins one node before the block
    const auto& neighbours = grid.neighbours(slot);
    for (int x = 0; x < edge; ++x) {
      for (int y = 0; y < edge; ++y) {
        const auto ux = static_cast<std::size_t>(x + skipped);
        const auto uy = static_cast<std::size_t>(y + skipped);
        const int row = grid::node_index(map.node[ux], map.node[uy], 0);
        const auto part = [&](int z_block, auto from, auto to) {
          const std::int32_t owner = neighbours[static_cast<std::size_t>(
              grid::neighbour_index(map.block[ux], map.block[uy], z_block))];
          if (owner == grid::BlockGrid::no_slot) return;
          auto* nodes = grid.nodes(static_cast<std::size_t>(owner), field);
          for (int z = from; z < to; ++z) {
            f(nodes, row + map.node[static_cast<std::size_t>(z + skipped)], index(x, y, z));
          }
        };
        using Number = std::integral_constant<int, before>;
        using Behind = std::integral_constant<int, before + grid::block_edge>;
        if constexpr (before > 0) part(0, std::integral_constant<int, 0>{}, Number{});
        part(1, Number{}, Behind{});
        part(2, Behind{}, std::integral_constant<int, edge>{});
      }
    }
  }

  std::array<Content, size> nodes_;
};

/// The nodes of the grid themselves, each found through the neighbours of the block.
template <class Shape>
class DirectAccess {
 public:
  DirectAccess(grid::BlockGrid& grid, std::size_t slot, unsigned field)
      : grid_(grid), neighbours_(grid.neighbours(slot)), field_(field) {}

  class Stencil {
   public:
    grid::Node& operator()(std::size_t i, std::size_t j, std::size_t k) const {
      return *node_[(i * count + j) * count + k];
    }

   private:
    friend class DirectAccess;
    static constexpr std::size_t count = Shape::count;
    std::array<grid::Node*, count * count * count> node_;
  };
  Stencil stencil(const std::array<int, 3>& first) {
    static constexpr grid::ReachMap map = grid::reach_map();
    Stencil all;
    grid::Node** next = all.node_.data();
    for (int i = first[0] + 1; i <= first[0] + Shape::count; ++i) {
      for (int j = first[1] + 1; j <= first[1] + Shape::count; ++j) {
        const auto ux = static_cast<std::size_t>(i), uy = static_cast<std::size_t>(j);
        const int row = grid::node_index(map.node[ux], map.node[uy], 0);
        for (int k = first[2] + 1; k <= first[2] + Shape::count; ++k) {
          const auto uz = static_cast<std::size_t>(k);
          const std::int32_t owner = neighbours_[static_cast<std::size_t>(
              grid::neighbour_index(map.block[ux], map.block[uy], map.block[uz]))];
          *next++ = grid_.nodes(static_cast<std::size_t>(owner), field_) + row + map.node[uz];
        }
      }
    }
    return all;
  }

 private:
  grid::BlockGrid& grid_;
  const std::array<std::int32_t, 27>& neighbours_;
  unsigned field_;
};

/// Calls f(points of one velocity field, access to its nodes) to read what the points of a block reach.
template <class Shape, class Content, class Function>
void read_nodes(grid::BlockGrid& grid, grid::BlockGrid::Points points, std::size_t slot, Function&& f) {
  grid.for_each_field(points, slot, [&](std::span<const std::uint32_t> members, unsigned field) {
    if (members.size() < direct_access_below) {
      DirectAccess<Shape> access(grid, slot, field);
      f(members, access);
    } else {
      ReachCopy<Shape, Content> copy;
      copy.load(grid, slot, field);
      f(members, copy);
    }
  });
}
/// The same to add to them.
template <class Shape, class Content, class Function>
void add_to_nodes(grid::BlockGrid& grid, grid::BlockGrid::Points points, std::size_t slot, Function&& f) {
  grid.for_each_field(points, slot, [&](std::span<const std::uint32_t> members, unsigned field) {
    if (members.size() < direct_access_below) {
      DirectAccess<Shape> access(grid, slot, field);
      f(members, access);
    } else {
      ReachCopy<Shape, Content> copy;
      copy.clear();
      f(members, copy);
      copy.add_to(grid, slot, field);
    }
  });
}

}  // namespace whipple::transfer

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "src/grid/block_grid.hpp"
#include "src/transfer/kernels/node_registers.hpp"
#include "src/transfer/shapes.hpp"

/// The nodes that the points of a block reach, and the two ways to them.
namespace whipple::transfer {

/// Blocks with fewer particles than this use direct access: that costs by the stencil, of which linear
/// functions have one for all particles of a cell.
template <class Shape>
constexpr std::size_t direct_access_below = Shape::count == 2 ? 16 : 6;

/// Copies the part of a node that a local copy holds: all of it, or only the first register.
template <class Vector>
WHIPPLE_INLINE inline void copy_node(const grid::Node& from, grid::Node& to) {
  store_node(to, load_node<Vector>(from));
}
template <class Vector>
WHIPPLE_INLINE inline void copy_node(const grid::Node& from, Lanes& to) {
  to = from.registers.first;
}
template <class Vector>
WHIPPLE_INLINE inline void add_node(const grid::Node& from, grid::Node& to) {
  store_node(to, load_node<Vector>(to) + load_node<Vector>(from));
}
template <class Vector>
WHIPPLE_INLINE inline void add_node(Lanes from, grid::Node& to) {
  to.registers.first += from;
}
template <class Vector>
WHIPPLE_INLINE inline void clear_node(grid::Node& node) {
  store_node(node, join_registers<Vector>(Lanes{}, Lanes{}));
}
template <class Vector>
WHIPPLE_INLINE inline void clear_node(Lanes& first) {
  first = Lanes{};
}
WHIPPLE_INLINE inline Lanes& first_register(grid::Node& node) { return node.registers.first; }
WHIPPLE_INLINE inline Lanes& first_register(Lanes& first) { return first; }

/// Copy of the nodes that a block reaches; index = position in the reach, z fastest.
/// @tparam Vector   register that nodes are copied by
/// @tparam Shape    its stencil gives the reach
/// @tparam Content  what is copied: grid::Node, or Lanes for the first register
template <class Vector, class Shape, class Content = grid::Node>
class ReachCopy {
 public:
  static constexpr int before = Shape::stencil.before(), edge = Shape::stencil.edge();
  static constexpr int edge_z = Shape::stencil.edge_z();
  static constexpr int size = edge * edge * edge_z;
  static constexpr grid::BlockShape block = Shape::stencil.block();
  static_assert(Shape::stencil.count <= edge - block.edge + 1);

  /// The nodes of one particle.
  struct Stencil {
    Content* origin;
    Content& operator()(std::size_t i, std::size_t j, std::size_t k) const {
      return origin[(i * edge + j) * edge_z + k];
    }
  };
  /// @param first  node, as of grid::PlaceInStencil
  Stencil stencil(std::int32_t first) { return {&nodes_[static_cast<std::size_t>(first)]}; }

  WHIPPLE_INLINE void clear() {
    for (Content& node : nodes_) clear_node<Vector>(node);
  }
  WHIPPLE_INLINE void load(const grid::BlockGrid& grid, std::size_t slot, unsigned field) {
    for_each_owner(grid, slot, field,
                   [&](const grid::Node* owner, int in_block, std::size_t here)
                       WHIPPLE_INLINE { copy_node<Vector>(owner[in_block], nodes_[here]); });
  }
  /// Adds the copy to the grid. Blocks of one colour do not overlap, so no two threads meet here.
  WHIPPLE_INLINE void add_to(grid::BlockGrid& grid, std::size_t slot, unsigned field) const {
    for_each_owner(grid, slot, field, [&](grid::Node* owner, int in_block, std::size_t here) WHIPPLE_INLINE {
      add_node<Vector>(nodes_[here], owner[in_block]);
    });
  }

 private:
  static constexpr std::size_t number(int n) { return static_cast<std::size_t>(n); }
  static std::size_t index(int x, int y, int z) { return number((x * edge + y) * edge_z + z); }

  /// Calls f(nodes of the owning block, index in it, index here) for every node of the reach whose block is
  /// active; no particle reaches the others.
  template <class Grid, class Function>
  WHIPPLE_INLINE static void for_each_owner(Grid& grid, std::size_t slot, unsigned field, Function&& f) {
    constexpr int skipped = 1 - before;  // the map begins one node before the block
    const auto& neighbours = grid.neighbours(slot);
    // Along a row, which is contiguous: the nodes of the block before, of the block, of the block behind.
    const auto row = [&](int block_x, int block_y, bool along_z, int first, std::size_t here) WHIPPLE_INLINE {
      const auto part = [&](int block_along, auto from, auto to) WHIPPLE_INLINE {
        const std::int32_t owner =
            neighbours[static_cast<std::size_t>(along_z ? grid::neighbour_index(block_x, block_y, block_along)
                                                        : grid::neighbour_index(block_x, block_along, 1))];
        if (owner == grid::BlockGrid::no_slot) return;
        auto* nodes = grid.nodes(static_cast<std::size_t>(owner), field);
        for (int n = from; n < to; ++n) {
          f(nodes, first + map.node[number(n + skipped)], here + number(n));
        }
      };
      using Number = std::integral_constant<int, before>;
      using Behind = std::integral_constant<int, before + block.edge>;
      if constexpr (before > 0) part(0, std::integral_constant<int, 0>{}, Number{});
      part(1, Number{}, Behind{});
      part(2, Behind{}, std::integral_constant<int, edge>{});
    };
    for (int x = 0; x < edge; ++x) {
      const std::size_t ux = number(x + skipped);
      if constexpr (edge_z == 1) {
        row(map.block[ux], 1, false, block.node(map.node[ux], 0, 0), index(x, 0, 0));
      } else {
        for (int y = 0; y < edge; ++y) {
          const std::size_t uy = number(y + skipped);
          row(map.block[ux], map.block[uy], true, block.node(map.node[ux], map.node[uy], 0), index(x, y, 0));
        }
      }
    }
  }

  static constexpr grid::ReachMap map = grid::reach_map(block.edge);
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
      return *node_[(i * count + j) * along_z + k];
    }

   private:
    friend class DirectAccess;
    static constexpr std::size_t count = Shape::count, along_z = count_z<Shape>;
    std::array<grid::Node*, count * count * along_z> node_;
  };
  /// @param first  node, as of grid::PlaceInStencil
  Stencil stencil(std::int32_t first) {
    static constexpr grid::BlockShape block = Shape::stencil.block();
    static constexpr grid::ReachMap map = grid::reach_map(block.edge), map_z = grid::reach_map(block.edge_z);
    constexpr int edge = Shape::stencil.edge(), edge_z = Shape::stencil.edge_z();
    constexpr int skipped = 1 - Shape::stencil.before(), skipped_z = 1 - Shape::stencil.before_z();
    const int x = first / (edge * edge_z) + skipped, y = first / edge_z % edge + skipped,
              z = first % edge_z + skipped_z;
    Stencil all;
    grid::Node** next = all.node_.data();
    for (int i = x; i < x + Shape::count; ++i) {
      for (int j = y; j < y + Shape::count; ++j) {
        const auto ux = static_cast<std::size_t>(i), uy = static_cast<std::size_t>(j);
        const int row = block.node(map.node[ux], map.node[uy], 0);
        for (int k = z; k < z + static_cast<int>(count_z<Shape>); ++k) {
          const auto uz = static_cast<std::size_t>(k);
          const std::int32_t owner = neighbours_[static_cast<std::size_t>(
              grid::neighbour_index(map.block[ux], map.block[uy], map_z.block[uz]))];
          *next++ = grid_.nodes(static_cast<std::size_t>(owner), field_) + row + map_z.node[uz];
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
template <class Vector, class Shape, class Content, class Function>
WHIPPLE_INLINE inline void read_nodes(grid::BlockGrid& grid, grid::BlockGrid::Points points, std::size_t slot,
                                      Function&& f) {
  grid.for_each_field(points, slot,
                      [&](std::span<const std::uint32_t> members, unsigned field) WHIPPLE_INLINE {
                        if (members.size() < direct_access_below<Shape>) {
                          DirectAccess<Shape> access(grid, slot, field);
                          f(members, access);
                        } else {
                          ReachCopy<Vector, Shape, Content> copy;
                          copy.load(grid, slot, field);
                          f(members, copy);
                        }
                      });
}
/// Calls `f` for the stencils of the points of a slot, to add to their nodes.
template <class Vector, class Shape, class Content, class Function>
WHIPPLE_INLINE inline void add_to_nodes(grid::BlockGrid& grid, grid::BlockGrid::Points points,
                                        std::size_t slot, Function&& f) {
  grid.for_each_field(points, slot,
                      [&](std::span<const std::uint32_t> members, unsigned field) WHIPPLE_INLINE {
                        if (members.size() < direct_access_below<Shape>) {
                          DirectAccess<Shape> access(grid, slot, field);
                          f(members, access);
                        } else {
                          // Those of the block itself arrive while its points are worked on.
                          const grid::Node* const own = grid.nodes(slot, field);
                          for (int i = 0; i < grid::nodes_per_block; ++i) __builtin_prefetch(own + i, 1, 2);
                          ReachCopy<Vector, Shape, Content> copy;
                          copy.clear();
                          f(members, copy);
                          copy.add_to(grid, slot, field);
                        }
                      });
}

}  // namespace whipple::transfer

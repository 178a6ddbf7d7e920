// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/core/base/vector_math.hpp"

/// How the kernels of elements divide a mesh (docs/theory/fem.md).
namespace whipple::fem {

/// Consecutive elements that the kernels take at a time, one per lane of a register.
struct ElementGroup {
  static constexpr std::size_t size = 8;

  std::uint32_t first;  ///< element
  std::uint16_t count;  ///< of elements
  std::uint8_t is_row;  ///< corner a of its elements: consecutive slots
  std::uint8_t along;   ///< 1 xi, 2 eta, 3 zeta: of rows in which each shares a face with the next; else 0
  /// Slot of each corner of each element, counted within the block; 0 for lanes without an element.
  std::array<std::array<std::uint16_t, size>, 8> slot;
  /// Location, for each corner, of the contiguous values of all elements: their slots if they are a row,
  /// otherwise `gathered_place`.
  std::array<std::uint16_t, 8> place;

  static constexpr std::size_t gathered_place(std::size_t corner);
};

/// Consecutive elements whose nodes the kernels take together: positions and velocities of the nodes are
/// copied to the first-level cache, forces are summed there first. Derived from the corners by `connect`.
struct Blocks {
  static constexpr std::size_t size = 256;  ///< elements

  [[nodiscard]] std::size_t count() const { return first_slot.size() - 1; }
  std::vector<std::uint32_t> first_group;  ///< the groups of block b: [first_group[b], first_group[b + 1])
  std::vector<ElementGroup> groups;
  std::vector<std::uint32_t> first_slot;  ///< the slots of block b: [first_slot[b], first_slot[b + 1])
  std::vector<std::uint32_t> slot_node;   ///< node of each slot, ascending in a block
  std::vector<std::uint32_t> first_of_node,
      slots_of_node;  ///< of node a, ascending, as in Mesh::first_corner
  /// `count` nodes from `node` on that have one slot each, from `slot` on.
  struct Run {
    std::uint32_t node, slot, count;
  };
  std::vector<Run> runs;                    ///< of nodes that have one slot
  std::vector<std::uint32_t> shared_nodes;  ///< those that have more, in several blocks
  std::vector<Vector3> slot_force;          ///< N, scratch of `internal_forces`
  bool forces_stand = false;                ///< `slot_force` is of the present positions and stresses
};

/// Behind all slots that a block may have.
constexpr std::size_t ElementGroup::gathered_place(std::size_t corner) {
  return 8 * Blocks::size + size * corner;
}

}  // namespace whipple::fem

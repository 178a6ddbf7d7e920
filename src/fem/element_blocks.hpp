// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/core/base/vector_math.hpp"

/// Division of a mesh by the element kernels (docs/theory/fem.md).
namespace whipple::fem {

/// Describes consecutive elements that the kernels process together, one per register lane.
struct ElementGroup {
  static constexpr std::size_t size = 8;

  std::uint32_t first;  ///< first element
  std::uint16_t count;  ///< number of elements
  std::uint8_t is_row;  ///< 1: corner a of consecutive elements is at consecutive slots
  std::uint8_t along;   ///< 1 xi, 2 eta, 3 zeta: rows whose elements share faces along it; else 0
  /// Holds the slot of each corner of each element, relative to the block; 0 for lanes without an element.
  std::array<std::array<std::uint16_t, size>, 8> slot;
  /// Holds, for each corner, the location of the contiguous values of all elements: their slots for a row, otherwise
  /// `gathered_place`.
  std::array<std::uint16_t, 8> place;

  static constexpr std::size_t gathered_place(std::size_t corner);
};

/// Describes blocks of consecutive elements whose nodes the kernels process together: positions and velocities of the
/// nodes are copied to the first-level cache, and forces are first summed there. Derived from the corners by `connect`.
struct Blocks {
  static constexpr std::size_t size = 256;  ///< elements

  [[nodiscard]] std::size_t count() const { return first_slot.size() - 1; }
  std::vector<std::uint32_t> first_group;  ///< the groups of block b: [first_group[b], first_group[b + 1])
  std::vector<ElementGroup> groups;
  std::vector<std::uint32_t> first_slot;  ///< the slots of block b: [first_slot[b], first_slot[b + 1])
  std::vector<std::uint32_t> slot_node;   ///< node of each slot, ascending in a block
  std::vector<std::uint32_t> first_of_node,
      slots_of_node;  ///< of node a, ascending, as in Mesh::first_corner
  /// Describes `count` nodes from `node` on with a single slot each, from `slot` on.
  struct Run {
    std::uint32_t node, slot, count;
  };
  std::vector<Run> runs;                    ///< of nodes with a single slot
  std::vector<std::uint32_t> shared_nodes;  ///< nodes with several slots, in several blocks
  std::vector<Vector3> slot_force;          ///< N, scratch of `internal_forces`
  bool forces_stand = false;                ///< `slot_force` is up to date with positions and stresses
};

/// Returns a location behind all slots of a block.
constexpr std::size_t ElementGroup::gathered_place(std::size_t corner) {
  return 8 * Blocks::size + size * corner;
}

}  // namespace whipple::fem

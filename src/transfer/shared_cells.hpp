// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/averaged_bodies.hpp"

namespace whipple::transfer {

/// Holds sums over the particles of averaged bodies in cells whose particles several ranks have: particles cross blocks
/// between two distributions of the blocks. A slot is divided for a body if particles of the body in it are on more
/// than one rank; no other sums are communicated. Without other ranks there is none.
class SharedCells {
 public:
  /// Finds the divided slots of each body. Call after every `bin`. Collective.
  void find(const Particles& particles, grid::BlockGrid& grid, const AveragedBodies& bodies);
  /// Returns whether a slot is divided for any body.
  [[nodiscard]] bool divide(std::size_t slot) const {
    return !sums_.begin.empty() && sums_.begin[slot] < sums_.begin[slot + 1];
  }
  /// Returns the sums of a body over the cells of a slot, in the order of the nodes of a block; none unless the slot is
  /// divided for this body.
  /// @param number  of the body among the averaged ones
  [[nodiscard]] std::span<Lanes> of(std::size_t slot, std::size_t number);
  /// Sets all sums to zero.
  void clear();
  /// Adds the sums of all ranks, and gives every rank their total. Collective, unless there is one rank.
  void add_ranks(grid::BlockGrid& grid);

 private:
  [[nodiscard]] bool is_divided(std::size_t slot, std::size_t number) const {
    return ranks_.values[ranks_.begin[slot] + number / lanes][number % lanes] > 1.0;
  }

  static constexpr std::size_t lanes = 4;
  grid::SlotValues ranks_;  // of each averaged body in each slot: number of ranks with particles of it
  grid::SlotValues sums_;
};

}  // namespace whipple::transfer

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "src/core/base/vector_math.hpp"
#include "src/grid/block_table.hpp"
#include "src/grid/field_set.hpp"
#include "src/grid/forest.hpp"
#include "src/grid/geometry.hpp"
#include "src/grid/stencil.hpp"

namespace whipple::grid {

/// Returns the index of a block among the 27 blocks around one, itself included.
constexpr int neighbour_index(int x, int y, int z) { return (x * 3 + y) * 3 + z; }

/// Calls f(position) for every set bit, from the lowest.
template <class Function>
void for_each_bit(std::uint64_t bits, Function&& f) {
  for (; bits != 0; bits &= bits - 1) f(static_cast<unsigned>(std::countr_zero(bits)));
}

/// Describes the work of a step, in any unit common to all ranks.
struct Work {
  std::span<const double> of_particle;  ///< of this rank; particles that are not listed count as 1
  double of_block = 0.0;  ///< of the nodes of a block with particles, regardless of their number
  std::size_t apart = 0;  ///< number of points, the last ones in the list, that are work but reach no nodes
};

/// Manages the active blocks of a rank and their neighbours. Slots number them: owned blocks in the order of the
/// forest's space-filling curve, those of the fine level first, then ghost blocks of other ranks that its particles
/// reach. A level has a forest, and its blocks have neighbours of their level only.
class Topology {
 public:
  static constexpr std::int32_t no_slot = BlockTable::none;
  /// Maximum number of nodes beyond a mirror plane in the stencil of a particle in front of it.
  static constexpr std::int32_t mirror_reach = 2;

  /// Returns the rank that owns the block of each particle; the particles must be there before `activate`.
  [[nodiscard]] std::vector<int> owners(std::span<const Vector3> position) const;
  /// Adds to `ranks`, without repetition, the owners of the blocks that a stencil at the position reaches; none for a
  /// position outside of the domain and its outer layer.
  void owners_reached(const Vector3& position, Stencil stencil, std::vector<int>& ranks) const;

  /// Returns the geometry of the finest level, including the shift of the nodes.
  [[nodiscard]] const Geometry& geometry() const { return geometries_.front(); }
  [[nodiscard]] BlockShape block_shape() const { return block_; }
  /// Return whether there are two levels of cells, and the levels.
  [[nodiscard]] bool has_two_levels() const { return geometries_.size() > 1; }
  [[nodiscard]] std::span<const Level> levels() const {
    static constexpr std::array<Level, 2> all = {Level::fine, Level::coarse};
    return std::span(all).first(geometries_.size());
  }
  [[nodiscard]] MPI_Comm communicator() const { return communicator_; }
  /// Returns the edge of the cells of a slot, m.
  [[nodiscard]] double cell_size(std::size_t slot) const { return geometry(slot).cell_size; }
  /// Returns the geometry of the level of a slot, or of a block.
  [[nodiscard]] const Geometry& geometry(std::size_t slot) const { return geometry(coordinate(slot)); }
  [[nodiscard]] const Geometry& geometry(const BlockCoordinate& block) const {
    return geometries_[number(block.level)];
  }
  [[nodiscard]] std::size_t slots() const { return blocks_.coordinate.size(); }
  /// Returns the number of blocks that this rank owns; they have the first slots, the others are ghost blocks.
  [[nodiscard]] std::size_t owned_slots() const { return blocks_.owned; }
  [[nodiscard]] const BlockCoordinate& coordinate(std::size_t slot) const { return blocks_.coordinate[slot]; }
  /// Returns the slots of the 27 blocks around a slot (see neighbour_index), `no_slot` where inactive.
  [[nodiscard]] const std::array<std::int32_t, 27>& neighbours(std::size_t slot) const {
    return neighbours_[slot];
  }
  /// Returns whether several ranks take part, so that blocks may be shared.
  [[nodiscard]] bool is_shared() const;
  /// Combines the bits of each slot over all ranks that use it (bitwise or). Collective.
  void join_bits_of_ranks(std::vector<std::uint64_t>& of_slot);
  /// Does so for sets of fields.
  void join_bits_of_ranks(std::vector<FieldSet>& of_slot);

  /// Returns the slot of the block around a position, `no_slot` if there is none.
  [[nodiscard]] std::int32_t slot_at(const Vector3& position) const {
    const std::optional<BlockCoordinate> block = block_of(position);
    return block ? table_.find(*block) : no_slot;
  }
  [[nodiscard]] std::int32_t slot_of(const BlockCoordinate& block) const { return table_.find(block); }
  /// Returns the block around a position, of the finest level that has functions there; none for a position beyond the
  /// outer layer, or NaN.
  [[nodiscard]] std::optional<BlockCoordinate> block_of(const Vector3& position) const {
    return block_of(position, geometry().level_at(position));
  }
  /// Returns the block of a level around a position.
  [[nodiscard]] std::optional<BlockCoordinate> block_of(const Vector3& position, Level level) const;

  [[nodiscard]] std::size_t forest_leaves() const;
  [[nodiscard]] std::size_t adaptations() const { return adaptations_; }

 protected:
  Topology(const Geometry& geometry, MPI_Comm communicator);
  /// Implement the functions of BlockGrid.
  void adapt(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
             Stencil stencil, const Work& work);
  void activate(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
                Stencil stencil);
  void shift(const Vector3& cells);
  /// Sets whether any field may be in contact with its image at a face.
  void set_apart_at(std::size_t face, bool apart) { apart_at_[face] = apart; }

  /// Returns a position in cells of the level of a slot.
  [[nodiscard]] Lanes in_cells(const Vector3& position, std::size_t slot) const {
    return geometry(slot).in_cells(position);
  }
  /// Returns the lower corner of the block of a slot, in cells.
  [[nodiscard]] Lanes corner(std::size_t slot) const { return corner_[slot]; }
  /// Returns the edges of a block, in cells.
  [[nodiscard]] Lanes edges() const { return edges_; }
  /// Returns one bit per active neighbour.
  [[nodiscard]] std::uint32_t existing(std::size_t slot) const { return existing_[slot]; }
  [[nodiscard]] const std::vector<BlockSet::Peer>& peers() const { return blocks_.peers; }
  [[nodiscard]] std::span<const BlockCoordinate> coordinates() const { return blocks_.coordinate; }

 private:
  [[nodiscard]] std::vector<WantedBlock> wanted_blocks(Level level, std::span<const Vector3> position,
                                                       std::span<const Vector3> velocity, double lookahead,
                                                       Stencil stencil, const Work& work) const;
  /// Describes a block with particles, and the neighbours that they reach.
  struct Home {
    WantedBlock block;
    std::uint32_t wanted = 0;  ///< one bit per neighbour; 0 without points on the grid
  };
  [[nodiscard]] std::vector<Home> homes(Level level, std::span<const Vector3> position,
                                        std::span<const Vector3> velocity, double lookahead, Stencil stencil,
                                        const Work& work) const;
  [[nodiscard]] bool contains(const BlockCoordinate& block) const;
  template <class Function>
  void for_each_mirror_block(const BlockCoordinate& block, Function&& f) const;

  MPI_Comm communicator_;
  std::vector<Geometry> geometries_;  // of each level, including the shift
  Vector3 origin_;                    // their lower corner without the shift
  BlockShape block_;
  Lanes edges_;             // of the block, in cells
  double foresight_ = 0.0;  // maximum motion of a stencil by shifts, cells
  std::array<bool, 6> apart_at_{};
  std::vector<Forest> forests_;  // of each level
  BlockTable table_;
  std::vector<std::vector<WantedBlock>> wanted_;  // by the last adaptation, of each level
  BlockSet blocks_;
  std::vector<std::array<std::int32_t, 27>> neighbours_;
  std::vector<std::uint32_t> existing_;
  std::vector<Lanes> corner_;
  std::size_t adaptations_ = 0;
};

}  // namespace whipple::grid

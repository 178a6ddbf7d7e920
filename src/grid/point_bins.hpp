// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "src/core/base/gaps.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/grid/topology.hpp"

namespace whipple::grid {

/// Lists points by block.
struct PointList {
  std::vector<std::uint32_t> begin;   ///< begin of each slot in `points`, and the end
  std::vector<std::uint32_t> points;  ///< indices, block by block

  [[nodiscard]] std::span<const std::uint32_t> in(std::size_t slot) const {
    return std::span(points).subspan(begin[slot], begin[slot + 1] - begin[slot]);
  }
};

/// Describes a particle with functions of both levels.
struct MixedParticle {
  std::uint32_t particle;
  Blend blend;
};

/// Locates the particles and off-grid points of a rank: the block of each, its place there, the lists of the blocks,
/// and the inactive blocks (docs/theory/mpm.md, section 8). Guests are off-grid points that use the nodes (nodes of
/// finite elements); they are listed separately.
class PointBins : public Topology {
 public:
  /// Counts the particles and off-grid points of this rank in every cell. Call after `bin`.
  void count_cells(std::span<const Vector3> position, std::span<const Vector3> guests = {});
  /// Returns whether the cells within two cells of a particle contain no other particle or off-grid point, mirror
  /// plane, or block shared with other ranks. Call `count_cells` before.
  [[nodiscard]] bool is_alone(std::uint32_t particle, const Vector3& position) const;
  /// Removes particles (ascending) from the lists of their blocks until the next `bin`: the transfers skip them.
  void release(std::span<const std::uint32_t> particles);
  /// Determines the inactive (quiescent) blocks and removes their particles from the lists. Call after `bin` and
  /// `release`. A block is active if it is restless or holds off-grid points, or if it is in one of `layers` successive
  /// layers around such blocks; a layer consists of the blocks whose points reach nodes of blocks that points of an
  /// active block reach. Collective.
  /// @param is_restless  is_restless(slot): whether material in the slot moves; not called for blocks that were
  /// inactive
  /// @returns number of particles of this rank in inactive blocks
  template <class IsRestless>
  std::size_t let_rest(int layers, IsRestless&& is_restless) {
    std::vector<std::uint64_t> awake(slots(), 0);
    parallel::for_each_uneven(slots(), [&](std::size_t s) {
      awake[s] = !guests_in(s).empty() || (resting_[s] == 0 && is_restless(s)) ? 1 : 0;
    });
    return let_rest_beyond(layers, std::move(awake));
  }
  /// Activates all blocks.
  void wake();
  /// Returns whether all particles of a chunk (from `chunk` times parallel::chunk_size) are in inactive blocks.
  [[nodiscard]] bool chunk_rests(std::size_t chunk) const;
  /// Returns a number that changes whenever particles may have been added, removed or reordered.
  [[nodiscard]] std::size_t arrangement() const { return arrangement_; }

  /// Records that order or number of the particles changed: the next `bin` looks up every block again.
  void particles_reordered();
  /// Records a new order of the particles, none of which has left: new[i] = old[order[i]]. On one rank the
  /// blocks remain known.
  void particles_reordered(std::span<const std::uint32_t> order);
  /// Records that particles left and others took their places: the blocks remain known.
  /// @param size  number of particles that remain
  void particles_removed(std::span<const Move> moves, std::size_t size);

  /// Returns the indices of the particles in a block, ascending; field by field while fields are divided.
  [[nodiscard]] std::span<const std::uint32_t> particles_in(std::size_t slot) const {
    return particles_.in(slot);
  }
  /// Returns the indices of the off-grid points in a block, ascending.
  [[nodiscard]] std::span<const std::uint32_t> guests_in(std::size_t slot) const { return guests_.in(slot); }
  /// Returns the position of the first particle of a slot in `particles_by_block`; for the slot after the last, the
  /// number of particles.
  [[nodiscard]] std::size_t place_of(std::size_t slot) const { return particles_.begin[slot]; }
  /// Returns all particles in active blocks, block by block: an order that keeps neighbours close in memory.
  [[nodiscard]] std::span<const std::uint32_t> particles_by_block() const { return particles_.points; }
  /// Lists the particles block by block, those of a block ordered by the first node of their stencils; all particles
  /// only after `wake`.
  void list_by_stencil(std::vector<std::uint32_t>& order) const;
  /// Particles by their own level, off-grid points, and the parts of mixed particles.
  enum class Points { particles, guests, parts };
  [[nodiscard]] std::span<const std::uint32_t> members(Points points, std::size_t slot) const {
    switch (points) {
      case Points::guests:
        return guests_in(slot);
      case Points::parts:
        return parts_in(slot);
      default:
        return particles_in(slot);
    }
  }
  /// Returns the stencil of the last `bin`.
  [[nodiscard]] Stencil stencil() const { return stencil_; }
  /// Returns the position of each point in its stencil at the last `bin`: the transfers of a step use it even if the
  /// points have moved since.
  [[nodiscard]] std::span<const PlaceInStencil> places(Points points) const {
    switch (points) {
      case Points::guests:
        return place_of_guest_;
      case Points::parts:
        return place_of_part_;
      default:
        return place_of_particle_;
    }
  }

  /// Particles with functions of both levels at the last `bin` (docs/theory/levels.md): each has a part on the fine level
  /// and one on the coarse level, 2 k and 2 k + 1 for the mixed particle k.
  [[nodiscard]] const std::vector<MixedParticle>& mixed() const { return mixed_; }
  /// Returns the number k of each particle, `not_mixed` of others; nothing if no particle is mixed.
  [[nodiscard]] std::span<const std::uint32_t> mixed_number() const { return mixed_number_; }
  static constexpr std::uint32_t not_mixed = ~std::uint32_t{0};
  /// Returns the parts in a block, ascending, of particles in active blocks.
  [[nodiscard]] std::span<const std::uint32_t> parts_in(std::size_t slot) const {
    return mixed_.empty() ? std::span<const std::uint32_t>() : parts_.in(slot);
  }
  /// Returns the mixed particle of a part, and the level of the part.
  [[nodiscard]] const MixedParticle& mixed_of_part(std::uint32_t part) const { return mixed_[part / 2]; }
  [[nodiscard]] std::size_t slot_of_part(std::uint32_t part) const {
    return static_cast<std::size_t>(slot_of_part_[part]);
  }
  [[nodiscard]] static Level level_of_part(std::uint32_t part) {
    return part % 2 == 0 ? Level::fine : Level::coarse;
  }
  /// Returns the edge of the cells of the block that holds a particle, m.
  [[nodiscard]] double cell_size_of(std::size_t p) const {
    return cell_size(static_cast<std::size_t>(slot_of_particle_[p]));
  }
  /// Returns the distance of a particle from the lower face along y at the last `bin` (m): the radius of a ring.
  [[nodiscard]] double radius_at_bin(std::size_t p) const {
    const auto slot = static_cast<std::size_t>(slot_of_particle_[p]);
    const PlaceInStencil& place = place_of_particle_[p];
    const double first =
        block_shape().edge * coordinate(slot)[1] + place.first_node_along_y_in_plane(stencil_);
    return (first + place.from_first(1)) * cell_size(slot);
  }

 protected:
  using Topology::Topology;
  [[nodiscard]] std::size_t bytes_of_bins() const {
    return slot_of_particle_.size() * 8 +
           (place_of_particle_.size() + place_of_guest_.size() + place_of_part_.size()) *
               sizeof(PlaceInStencil) +
           mixed_.size() * sizeof(MixedParticle) + (mixed_number_.size() + slot_of_part_.size()) * 4;
  }
  /// Implements BlockGrid::bin.
  bool bin(std::span<const Vector3> position, Stencil stencil, std::span<const Vector3> guests);
  /// Finds the slot of every particle; returns false if one is outside of the active set.
  bool look_up(std::span<const Vector3> position);
  /// Makes the next `bin` process all particles individually.
  void forget_runs();
  /// Returns the particles of a block, to be reordered until the next `bin`.
  [[nodiscard]] std::span<std::uint32_t> listed_in(std::size_t slot) {
    return std::span(particles_.points).subspan(particles_.begin[slot], particles_in(slot).size());
  }

 private:
  bool locate(std::span<const Vector3> position, Stencil stencil);
  [[nodiscard]] std::int32_t slot_of_neighbour(std::size_t slot, Lanes in_cells) const;
  bool locate_guests(std::span<const Vector3> guests, Stencil stencil);
  bool locate_parts(std::span<const Vector3> position);
  std::size_t let_rest_beyond(int layers, std::vector<std::uint64_t> awake);
  void list_particles();
  void list_guests();
  void list_parts();
  void wake_both_levels(std::vector<std::uint64_t>& awake);

  Stencil stencil_;
  std::vector<std::int32_t> slot_of_particle_, reordered_;  // the latter: memory for the next reordering
  // Of each slot: one bit per neighbour whose nodes its points may reach
  std::vector<std::uint32_t> reached_;
  std::vector<std::uint16_t> cell_count_;  // particles in each cell of each slot
  std::vector<std::uint8_t> unshared_;     // of each slot: 1 if no other rank uses it
  std::vector<std::uint32_t> released_;    // particles, ascending
  std::vector<std::uint8_t> resting_;      // of each slot, while `runs_known_`
  std::vector<std::int32_t> slot_of_guest_;
  std::vector<PlaceInStencil> place_of_particle_, place_of_guest_;
  std::vector<MixedParticle> mixed_;
  std::vector<std::uint32_t> mixed_number_;  // of each particle; empty: none is mixed
  std::vector<std::int32_t> slot_of_part_;
  std::vector<PlaceInStencil> place_of_part_;
  PointList particles_, guests_, parts_;
  /// Describes particles of one block that are contiguous in memory.
  struct Run {
    std::uint32_t slot = 0;
    std::uint32_t begin = 0, end = 0;
    std::uint32_t place = 0;  ///< of the first one in the list of particles
  };
  std::vector<std::vector<Run>> runs_;  // of each chunk of particles
  bool runs_known_ = false;             // from the last `bin`
  std::size_t arrangement_ = 0;
  std::vector<std::uint32_t> next_;  // position of the next point of each slot during list construction
};

}  // namespace whipple::grid

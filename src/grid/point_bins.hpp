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

/// Points by block.
struct PointList {
  std::vector<std::uint32_t> begin;   ///< of each slot in `points`, and the end
  std::vector<std::uint32_t> points;  ///< indices, block by block

  [[nodiscard]] std::span<const std::uint32_t> in(std::size_t slot) const {
    return std::span(points).subspan(begin[slot], begin[slot + 1] - begin[slot]);
  }
};

/// Where the particles and off-grid points of a rank are: the block of each, its place there, the lists of the blocks, and which
/// of the blocks rest (docs/theory/mpm.md, section 8). Guests are off-grid points that use the nodes (nodes of finite
/// elements): listed apart.
class PointBins : public Topology {
 public:
  /// Counts the particles and off-grid points of this rank in every cell, after `bin`.
  void count_cells(std::span<const Vector3> position, std::span<const Vector3> guests = {});
  /// Returns whether a particle of this rank is farther than two cells from all other particles, off-grid
  /// points, mirror planes, and blocks shared with other ranks. Call `count_cells` before.
  [[nodiscard]] bool is_alone(std::uint32_t particle, const Vector3& position) const;
  /// Takes particles (ascending) off the lists of their blocks until the next `bin`: the transfers do not see
  /// them.
  void release(std::span<const std::uint32_t> particles);
  /// Finds the blocks at rest and takes their particles off the lists; after `bin` and `release`.
  /// Awake are blocks that are restless or hold off-grid points, and `layers` of blocks around them, one after the
  /// other: those that reach nodes of blocks whose nodes an awake one reaches. Collective.
  /// @param is_restless  is_restless(slot): does something in it move? Not asked of blocks that rested before
  /// @returns number of particles of this rank at rest
  template <class IsRestless>
  std::size_t let_rest(int layers, IsRestless&& is_restless) {
    std::vector<std::uint64_t> awake(slots(), 0);
    parallel::for_each_uneven(slots(), [&](std::size_t s) {
      awake[s] = !guests_in(s).empty() || (resting_[s] == 0 && is_restless(s)) ? 1 : 0;
    });
    return let_rest_beyond(layers, std::move(awake));
  }
  /// No block rests any longer.
  void wake();
  /// Returns whether all particles of a chunk (from `chunk` times parallel::chunk_size on) are in inactive
  /// blocks.
  [[nodiscard]] bool chunk_rests(std::size_t chunk) const;
  /// Changes whenever particles may have come, gone or changed their order.
  [[nodiscard]] std::size_t arrangement() const { return arrangement_; }

  /// Particles changed their order or number: the next `bin` looks every block up again.
  void particles_reordered();
  /// Records a new order of the particles, none of which has left: new[i] = old[order[i]]. On one rank the
  /// blocks remain known.
  void particles_reordered(std::span<const std::uint32_t> order);
  /// Particles left and others took their places: the blocks stay known.
  /// @param size  number of particles that stay
  void particles_removed(std::span<const Move> moves, std::size_t size);

  /// Indices of the particles in a block, ascending; field by field while fields are divided.
  [[nodiscard]] std::span<const std::uint32_t> particles_in(std::size_t slot) const {
    return particles_.in(slot);
  }
  /// Indices of the off-grid points in a block, ascending.
  [[nodiscard]] std::span<const std::uint32_t> guests_in(std::size_t slot) const { return guests_.in(slot); }
  /// Place of the first particle of a slot in `particles_by_block`; of the slot behind the last: how many
  /// there are.
  [[nodiscard]] std::size_t place_of(std::size_t slot) const { return particles_.begin[slot]; }
  /// All particles that do not rest, block by block: an order that keeps neighbours in memory near one
  /// another.
  [[nodiscard]] std::span<const std::uint32_t> particles_by_block() const { return particles_.points; }
  /// Lists particles like `list`, those of a block ordered by the first node of their stencils; all particles
  /// only after `wake`.
  void list_by_stencil(std::vector<std::uint32_t>& order) const;
  enum class Points { particles, guests };
  [[nodiscard]] std::span<const std::uint32_t> members(Points points, std::size_t slot) const {
    return points == Points::particles ? particles_in(slot) : guests_in(slot);
  }
  /// The stencil of the last `bin`.
  [[nodiscard]] Stencil stencil() const { return stencil_; }
  /// Returns the position of each point in its stencil as binned: the transfers of a step use it, wherever
  /// the positions have moved since.
  [[nodiscard]] std::span<const PlaceInStencil> places(Points points) const {
    return points == Points::particles ? place_of_particle_ : place_of_guest_;
  }
  /// Distance of a particle from the lower face along y at the last `bin` (m): the radius of a ring.
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
           (place_of_particle_.size() + place_of_guest_.size()) * sizeof(PlaceInStencil);
  }
  /// As of BlockGrid.
  bool bin(std::span<const Vector3> position, Stencil stencil, std::span<const Vector3> guests);
  /// Finds the slot of every particle; false if one is outside of the active set.
  bool look_up(std::span<const Vector3> position);
  /// The next `bin` goes through all particles.
  void forget_runs();
  /// Particles of a block, to be put in another order until the next `bin`.
  [[nodiscard]] std::span<std::uint32_t> listed_in(std::size_t slot) {
    return std::span(particles_.points).subspan(particles_.begin[slot], particles_in(slot).size());
  }

 private:
  bool locate(std::span<const Vector3> position, Stencil stencil);
  [[nodiscard]] std::int32_t slot_of_neighbour(std::size_t slot, Lanes in_cells) const;
  bool locate_guests(std::span<const Vector3> guests, Stencil stencil);
  std::size_t let_rest_beyond(int layers, std::vector<std::uint64_t> awake);
  void list_particles();
  void list_guests();

  Stencil stencil_;
  std::vector<std::int32_t> slot_of_particle_, reordered_;  // the latter: memory for the next sort
  std::vector<std::uint32_t> reached_;     // of each slot: bit per neighbour whose nodes its points may reach
  std::vector<std::uint16_t> cell_count_;  // particles in each cell of each slot
  std::vector<std::uint8_t> unshared_;     // slots that no other rank works with
  std::vector<std::uint32_t> released_;    // particles, ascending
  std::vector<std::uint8_t> resting_;      // of each slot, while `runs_known_`
  std::vector<std::int32_t> slot_of_guest_;
  std::vector<PlaceInStencil> place_of_particle_, place_of_guest_;
  PointList particles_, guests_;
  /// Particles of one block that follow one another in memory.
  struct Run {
    std::uint32_t slot = 0;
    std::uint32_t begin = 0, end = 0;
    std::uint32_t place = 0;  ///< of the first in the list of particles
  };
  std::vector<std::vector<Run>> runs_;  // of each chunk of particles
  bool runs_known_ = false;             // from the last `bin`
  std::size_t arrangement_ = 0;
  std::vector<std::uint32_t> next_;  // place for the next point of each slot, while lists are made
};

}  // namespace whipple::grid

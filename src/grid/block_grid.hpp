// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/core/parallel/threads.hpp"
#include "src/grid/node_store.hpp"
#include "src/grid/slot_messages.hpp"

namespace whipple::grid {

/// The sparse background grid: the blocks where particles are (Topology), the lists of particles in each block
/// (PointBins), the velocity fields of the particles (VelocityFields), the nodes of the blocks (NodeStore), and here how
/// these follow the particles, and what ranks tell each other about nodes. Each part sees those named before it.
class BlockGrid : public NodeStore {
 public:
  /// Collective over `communicator`.
  BlockGrid(const Geometry& geometry, MPI_Comm communicator) : NodeStore(geometry, communicator) {}

  /// Finds the block of every particle and lists the particles by block, in the order of their index. Blocks
  /// that rest (`let_rest`) stay off the lists until something comes to them: their particles must not have
  /// moved.
  /// @param guests off-grid points that use the nodes (nodes of finite elements): listed apart
  /// @returns false, on every rank, if the stencil of some particle or off-grid point reaches beyond the active
  /// blocks: then `adapt` and `activate` must follow, and another `bin`. Collective.
  bool bin(std::span<const Vector3> position, Stencil stencil, std::span<const Vector3> guests = {}) {
    return PointBins::bin(position, stencil, guests);
  }

  /// Lets the forest follow the particles: finest leaves where stencils reach, now and along the motion over
  /// `lookahead` seconds, so that it need not be adapted every step; and divides the blocks again among the
  /// ranks if their work has drifted apart. Collective.
  /// @param position of the particles, then of the off-grid points, then of what is work apart from the grid
  /// @param work  by what the blocks are shared out among the ranks
  /// @throws StateError on every rank if a particle is outside of the domain and its outer layer (names the
  /// index)
  void adapt(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
             Stencil stencil, const Work& work = {}) {
    Topology::adapt(position, velocity, lookahead, stencil, work);
  }
  /// Activates the blocks that the particles of this rank reach, own ones and those that it borrows from
  /// other ranks; drops the others. Collective.
  /// @param guests number of the positions, the last ones, that are off-grid points
  void activate(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
                Stencil stencil, std::size_t guests = 0);

  /// Moves the nodes away from where the geometry has them, by at most half a cell along each axis; before
  /// `bin`. Axes with mirror planes must not be moved.
  void shift(const Vector3& cells);

  /// Gives every field nodes of its own in the slots that several fields reach; after `bin` and `release`,
  /// for the lists that these made. Without a call there is one field. Collective.
  /// @param fields      number of fields
  /// @param everywhere  nodes of their own for all fields in all slots: for comparison
  void separate_fields(Stencil stencil, const FieldPoints& particles, const FieldPoints& guests,
                       unsigned fields, bool everywhere = false);

  /// The border are the slots whose points may reach nodes that other ranks wait for or send: worked on first
  /// when points bring something to the nodes, and last when they take something, so that the exchange goes
  /// on behind the interior. Each rank has its own; alone it has no border.
  enum class Region { border, interior };
  [[nodiscard]] Region region(std::size_t slot) const {
    return is_at_border(slot) ? Region::border : Region::interior;
  }
  /// Calls f(slot) on threads, for all slots with particles or off-grid points, no two at a time whose reaches
  /// overlap.
  template <class Function>
  void for_each_apart(Function&& f) const {
    for (const Region region : {Region::border, Region::interior}) for_each_apart(region, f);
  }
  template <class Function>
  void for_each_apart(Region region, Function&& f) const {
    for (const SlotGroups& colour : apart_[static_cast<std::size_t>(region)]) {
      if (colour.slots.empty()) continue;
      parallel::for_each_uneven(colour.begin.size() - 1, [&](std::size_t group) {
        for (std::size_t i = colour.begin[group]; i < colour.begin[group + 1]; ++i) {
          const std::uint32_t slot = colour.slots[i];
          if (!particles_in(slot).empty() || !guests_in(slot).empty()) f(slot);
        }
      });
    }
  }

  /// Registers of the nodes that are communicated.
  enum class Part { first, both };
  /// Adds what this rank's particles brought to ghost nodes to the nodes of their owners. Collective.
  void sum_to_owners(Part part) {
    begin_sum_to_owners(part);
    finish_sum_to_owners(part);
  }
  /// Replaces the ghost nodes by those of their owners. Collective.
  void borrow_from_owners(Part part) {
    begin_borrow_from_owners(part);
    finish_borrow_from_owners(part);
  }
  /// Performs these exchanges in two halves, one exchange at a time. Between the halves ghost nodes must not
  /// be read after `begin_borrow_from_owners`; sent data are copied at the start.
  void begin_sum_to_owners(Part part);
  void finish_sum_to_owners(Part part);
  void begin_borrow_from_owners(Part part);
  void finish_borrow_from_owners(Part part);
  /// Lets messages under way go on, where work on nodes would leave them alone for long. On the thread that
  /// called MPI's initialization; others return at once.
  void progress();
  /// Exchanges values at contact slots in the same way. Collective.
  void sum_to_owners(ContactValues& values);
  void sum_to_owners(SlotValues& values);
  void borrow_from_owners(ContactValues& values);
  /// Replaces the owners' values by the largest of all ranks. Collective.
  void maximum_to_owners(ContactValues& values);
  void borrow_from_owners(SlotValues& values);
  void maximum_to_owners(SlotValues& values);

  [[nodiscard]] std::size_t bytes() const;

 private:
  void set_apart();
  void send_nodes(Part part, SharedSlots from, SharedSlots to);
  template <class Combine>
  void receive_nodes(Part part, SharedSlots to, Combine&& combine);
  template <class Range, class Combine>
  void exchange_values(Range&& range, SharedSlots from, SharedSlots to, Combine&& combine);

  /// Slots in groups: single blocks, or where there are many, cubes of two by two by two. A thread works
  /// through a cube on its own: its blocks follow one another in memory, and so do their particles.
  struct SlotGroups {
    std::vector<std::uint32_t> slots, begin;  ///< begin: of each group, and the end
  };
  static constexpr std::size_t slots_for_cubes = 1024;
  /// By region, for each of eight colours: groups whose reaches do not overlap.
  std::array<std::array<SlotGroups, 8>, 2> apart_;
  SlotMessages<Lanes> node_messages_;
};

}  // namespace whipple::grid

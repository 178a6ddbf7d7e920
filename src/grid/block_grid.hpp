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

/// Represents the sparse background grid: the active blocks (Topology), the lists of points in each block (PointBins),
/// the velocity fields of the points (VelocityFields), the nodes of the blocks (NodeStore) and, here, the adaptation to
/// the motion of the particles and the exchange of nodes between ranks. Each part depends only on those named before
/// it.
class BlockGrid : public NodeStore {
 public:
  /// Creates a grid without active blocks. Collective over `communicator`.
  BlockGrid(const Geometry& geometry, MPI_Comm communicator) : NodeStore(geometry, communicator) {}

  /// Finds the block of every particle and lists the particles by block, in the order of their index. Inactive blocks
  /// (`let_rest`) remain off the lists until a particle enters them: their particles must not have moved. Collective.
  /// @param guests off-grid points that use the nodes (nodes of finite elements); listed separately
  /// @returns false, on every rank, if the stencil of a particle or off-grid point reaches beyond the active blocks:
  /// then `adapt` and `activate` must follow, and another `bin`
  bool bin(std::span<const Vector3> position, Stencil stencil, std::span<const Vector3> guests = {}) {
    return PointBins::bin(position, stencil, guests);
  }

  /// Adapts the forest to the particles: finest leaves where stencils reach, now and along the motion over `lookahead`
  /// seconds, so that adaptation is not required in every step. Repartitions the blocks if the load of the ranks has
  /// become unequal. Collective.
  /// @param position of the particles, then of the off-grid points, then of the points that are work but use no nodes
  /// @param work  determines the distribution of the blocks over the ranks
  /// @throws StateError on every rank if a particle is outside of the domain and its outer layer (states the index)
  void adapt(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
             Stencil stencil, const Work& work = {}) {
    Topology::adapt(position, velocity, lookahead, stencil, work);
  }
  /// Activates the blocks that the particles of this rank reach, owned blocks and ghost blocks of other ranks;
  /// deactivates all others. Collective.
  /// @param guests number of positions, the last ones, that are off-grid points
  void activate(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
                Stencil stencil, std::size_t guests = 0);

  /// Moves the nodes relative to the geometry by at most half a cell along each axis. Call before `bin`. Axes with
  /// mirror planes must not be moved.
  void shift(const Vector3& cells);

  /// Creates separate nodes for each field in the slots that several fields reach. Call after `bin` and `release`, for
  /// the lists that these created. Without a call there is one field. Collective.
  /// @param fields      number of fields
  /// @param everywhere  separate nodes for all fields in all slots, for comparison
  void separate_fields(Stencil stencil, const FieldPoints& particles, const FieldPoints& guests,
                       unsigned fields, bool everywhere = false);

  /// Divides the slots into border and interior. Points of the border may reach nodes that other ranks await or send:
  /// it is processed first when points contribute to nodes and last when they gather from them, so that communication
  /// overlaps with computation in the interior. Each rank has its own border; a single rank has none.
  enum class Region { border, interior };
  [[nodiscard]] Region region(std::size_t slot) const {
    return is_at_border(slot) ? Region::border : Region::interior;
  }
  /// Calls f(slot) on threads for all slots with particles or off-grid points; slots with overlapping reaches are never
  /// processed concurrently.
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
          if (!particles_in(slot).empty() || !guests_in(slot).empty() || !parts_in(slot).empty()) f(slot);
        }
      });
    }
  }

  /// Selects the registers of the nodes that are communicated.
  enum class Part { first, both };
  /// Adds the contributions of this rank to ghost nodes to the nodes of their owners. Collective.
  void sum_to_owners(Part part) {
    begin_sum_to_owners(part);
    finish_sum_to_owners(part);
  }
  /// Replaces the ghost nodes by the nodes of their owners. Collective.
  void borrow_from_owners(Part part) {
    begin_borrow_from_owners(part);
    finish_borrow_from_owners(part);
  }
  /// Performs these exchanges in two halves, one exchange at a time. Ghost nodes must not be read after
  /// `begin_borrow_from_owners` until the exchange is finished; sent data are copied at the start.
  void begin_sum_to_owners(Part part);
  void finish_sum_to_owners(Part part);
  void begin_borrow_from_owners(Part part);
  void finish_borrow_from_owners(Part part);
  /// Advances pending messages during long computations between the halves of an exchange. Acts only on the thread that
  /// initialised MPI; other threads return at once.
  void progress();
  /// Exchanges values at contact slots, or at all slots, in the same way. Collective.
  void sum_to_owners(ContactValues& values);
  void sum_to_owners(SlotValues& values);
  void borrow_from_owners(ContactValues& values);
  /// Replaces the owners' values by the maximum over all ranks. Collective.
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

  /// Holds slots in groups: single blocks or, where there are many, cubes of two by two by two. One thread processes a
  /// cube: its blocks are contiguous in memory, and so are their particles.
  struct SlotGroups {
    std::vector<std::uint32_t> slots, begin;  ///< begin of each group, and the end
  };
  static constexpr std::size_t slots_for_cubes = 1024;
  /// By region, for each of eight colours: groups with disjoint reaches.
  std::array<std::array<SlotGroups, 8>, 2> apart_;
  SlotMessages<Lanes> node_messages_;
};

}  // namespace whipple::grid

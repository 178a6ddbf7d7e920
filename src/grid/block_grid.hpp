// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "src/core/base/gaps.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/grid/block_table.hpp"
#include "src/grid/forest.hpp"
#include "src/grid/geometry.hpp"
#include "src/grid/stencil.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::grid {

/// Payload of a node, two registers of four doubles (SI).
/// After particles_to_grid: `first` = mass, momentum x y z;           `second` = mass * sound speed, force x
/// y z. After the grid update:   `first` = velocity x y z, relaxation beta; `second` = velocity increment x y
/// z, heat per mass (J/kg) that contact gives to the particles around (docs/theory/contact.md, 4).
struct alignas(64) Node {
  Lanes first;
  Lanes second;
};

/// Work of a step, in any unit that all ranks share.
struct Work {
  std::span<const double> of_particle;  ///< of this rank; those that are not listed count as 1
  double of_block = 0.0;                ///< of the nodes of a block with particles, whatever their number
  std::size_t apart = 0;  ///< of the points listed, the last so many are work but reach no nodes
};

constexpr int node_index(int x, int y, int z) { return (x * block_edge + y) * block_edge + z; }
constexpr int neighbour_index(int x, int y, int z) { return (x * 3 + y) * 3 + z; }

/// Points by block.
struct PointList {
  std::vector<std::uint32_t> begin;   ///< of each slot in `points`, and the end
  std::vector<std::uint32_t> points;  ///< indices, block by block

  [[nodiscard]] std::span<const std::uint32_t> in(std::size_t slot) const {
    return std::span(points).subspan(begin[slot], begin[slot + 1] - begin[slot]);
  }
};

/// Calls f(position) for every bit that is set, from the lowest.
template <class Function>
void for_each_bit(std::uint64_t bits, Function&& f) {
  for (; bits != 0; bits &= bits - 1) f(static_cast<unsigned>(std::countr_zero(bits)));
}

/// Values that go with the contact slots of a grid: those of slot number c stand from begin[c] to begin[c +
/// 1].
struct ContactValues {
  std::vector<Lanes> values;
  std::vector<std::uint32_t> begin;
};

/// Values that go with all blocks of nodes of some slots, of which every rank that works with them knows as
/// many: those of slot s stand from begin[s] to begin[s + 1].
struct SlotValues {
  std::vector<Lanes> values;
  std::vector<std::uint32_t> begin;
};

/// The sparse background grid: the blocks where particles are, their nodes, and the list of particles in each
/// block. Slots number the active blocks of a rank: its own in the order of the forest's space-filling curve,
/// then those that it borrows from other ranks because its particles reach them.
///
/// Particles may belong to several velocity fields. A slot that particles of more than one field reach is a
/// contact slot and has nodes for each of them; elsewhere all fields share the one set (local multi-mesh:
/// docs/theory/contact.md, 2). Blocks of nodes are numbered by slot, then come the further ones of the
/// contact slots.
class BlockGrid {
 public:
  static constexpr std::int32_t no_slot = BlockTable::none;
  /// Nodes beyond a mirror plane that the stencil of a particle before it may hold.
  static constexpr std::int32_t mirror_reach = 2;

  /// Collective over `communicator`.
  BlockGrid(const Geometry& geometry, MPI_Comm communicator);

  /// Finds the block of every particle and lists the particles by block, in the order of their index. Blocks
  /// that rest (`let_rest`) stay off the lists until something comes to them: their particles must not have
  /// moved.
  /// @param guests off-grid points that use the nodes (nodes of finite elements): listed apart
  /// @returns false, on every rank, if the stencil of some particle or off-grid point reaches beyond the active
  /// blocks: then `adapt` and `activate` must follow, and another `bin`. Collective.
  bool bin(std::span<const Vector3> position, Stencil stencil, std::span<const Vector3> guests = {});

  /// Lets the forest follow the particles: finest leaves where stencils reach, now and along the motion over
  /// `lookahead` seconds, so that it need not be adapted every step; and divides the blocks again among the
  /// ranks if their work has drifted apart. Collective.
  /// @param position of the particles, then of the off-grid points, then of what is work apart from the grid
  /// @param work  by what the blocks are shared out among the ranks
  /// @throws StateError on every rank if a particle is outside of the domain and its outer layer (names the
  /// index)
  void adapt(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
             Stencil stencil, const Work& work = {});
  /// Rank that owns the block of each particle, which is where the particle must be before `activate`.
  [[nodiscard]] std::vector<int> owners(std::span<const Vector3> position) const;
  /// Adds to `ranks` those that own a block that a stencil at the position reaches, each once; nothing for a
  /// position outside of the domain and its outer layer.
  void owners_reached(const Vector3& position, Stencil stencil, std::vector<int>& ranks) const;
  /// Activates the blocks that the particles of this rank reach, own ones and those that it borrows from
  /// other ranks; drops the others. Collective.
  /// @param guests number of the positions, the last ones, that are off-grid points
  void activate(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
                Stencil stencil, std::size_t guests = 0);

  /// Moves the nodes away from where the geometry has them, by at most half a cell along each axis; before
  /// `bin`. Axes with mirror planes must not be moved.
  void shift(const Vector3& cells);

  /// Counts the particles and off-grid points of this rank in every cell, after `bin`.
  void count_cells(std::span<const Vector3> position, std::span<const Vector3> guests = {});
  /// Returns whether a particle of this rank is farther than two cells from all other particles, off-grid
  /// points, mirror planes, and blocks shared with other ranks. Call `count_cells` before.
  [[nodiscard]] bool is_alone(std::uint32_t particle, const Vector3& position) const;
  /// Takes particles (ascending) off the lists of their blocks until the next `bin`: the transfers do not see
  /// them.
  void release(std::span<const std::uint32_t> particles);
  /// Finds the blocks at rest and takes their particles off the lists; after `bin` and `release`.
  /// Active are blocks that are restless or hold off-grid points, and `layers` of blocks around them, one after the
  /// other: those that reach nodes of blocks whose nodes an awake one reaches. Collective.
  /// @param is_restless  is_restless(slot): does something in it move? Not asked of blocks that rested before
  /// @returns number of particles of this rank at rest
  std::size_t let_rest(int layers, const std::function<bool(std::size_t)>& is_restless);
  /// No block rests any longer.
  void wake();
  /// Returns whether all particles of a chunk (from `chunk` times parallel::chunk_size on) are in inactive
  /// blocks.
  [[nodiscard]] bool chunk_rests(std::size_t chunk) const;
  /// Changes whenever particles may have come, gone or changed their order.
  [[nodiscard]] std::size_t arrangement() const { return arrangement_; }

  /// Points of the grid with the velocity field (below `maximum_fields`) of each.
  struct FieldPoints {
    std::span<const Vector3> position;
    std::span<const std::uint8_t> field;
  };
  /// Gives every field nodes of its own in the slots that several fields reach; after `bin` and `release`,
  /// for the lists that these made. Without a call there is one field. Collective.
  /// @param fields      number of fields
  /// @param everywhere  nodes of their own for all fields in all slots: for comparison
  void separate_fields(Stencil stencil, const FieldPoints& particles, const FieldPoints& guests,
                       unsigned fields, bool everywhere = false);

  /// Particles changed their order or number: the next `bin` looks every block up again.
  void particles_reordered();
  /// Records a new order of the particles, none of which has left: new[i] = old[order[i]]. On one rank the
  /// blocks remain known.
  void particles_reordered(std::span<const std::uint32_t> order);
  /// Particles left and others took their places: the blocks stay known.
  /// @param size  number of particles that stay
  void particles_removed(std::span<const Move> moves, std::size_t size);

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] MPI_Comm communicator() const { return communicator_; }
  [[nodiscard]] std::size_t slots() const { return blocks_.coordinate.size(); }
  /// The first so many slots are blocks of this rank; the others are ghost blocks.
  [[nodiscard]] std::size_t owned_slots() const { return blocks_.owned; }
  [[nodiscard]] const BlockCoordinate& coordinate(std::size_t slot) const { return blocks_.coordinate[slot]; }
  /// Slots of the 27 blocks around a slot (see neighbour_index), `no_slot` where inactive.
  [[nodiscard]] const std::array<std::int32_t, 27>& neighbours(std::size_t slot) const {
    return neighbours_[slot];
  }
  /// Indices of the particles in a block, ascending.
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
  /// The border are the slots whose points may reach nodes that other ranks wait for or send: worked on first
  /// when points bring something to the nodes, and last when they take something, so that the exchange goes
  /// on behind the interior. Each rank has its own; alone it has no border.
  enum class Region { border, interior };
  [[nodiscard]] Region region(std::size_t slot) const {
    return !border_.empty() && border_[slot] != 0 ? Region::border : Region::interior;
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
  /// Returns how far apart in memory those nodes of a block are that particles reach: in two dimensions they lie in the
  /// plane z = lower, and z is the fastest direction.
  [[nodiscard]] std::size_t step_of_nodes() const { return geometry_.is_planar() ? block_edge : 1; }
  /// Distance of a particle from the lower face along y at the last `bin` (m): the radius of a ring.
  [[nodiscard]] double radius_at_bin(std::size_t p) const {
    const auto slot = static_cast<std::size_t>(slot_of_particle_[p]);
    const PlaceInStencil& place = place_of_particle_[p];
    const double first = block_edge * coordinate(slot)[1] + place.first_node(stencil_)[1];
    return (first + place.from_first(1)) * geometry_.cell_size;
  }
  /// Calls f(points of one field, field) for the points of a slot, in the order of their indices; once for
  /// all of them where they reach no contact slot, and not at all where there are none.
  template <class Function>
  void for_each_field(Points points, std::size_t slot, Function&& f) const {
    const std::span<const std::uint32_t> all = members(points, slot);
    if (all.empty()) return;
    if (!meets_contact(slot)) {
      f(all, 0U);
      return;
    }
    const std::vector<std::uint8_t>& field_of = points == Points::particles ? field_ : field_of_guest_;
    for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
      const std::uint8_t field = field_of[all[i]];
      for (end = i + 1; end < all.size() && field_of[all[end]] == field;) ++end;
      f(all.subspan(i, end - i), static_cast<unsigned>(field));
    }
  }
  /// Returns whether particles of a slot reach contact slots.
  [[nodiscard]] bool meets_contact(std::size_t slot) const {
    return !contact_slots_.empty() && meets_contact_[slot] != 0;
  }

  /// The nodes of a slot for a field; those of the slot itself where the field has none of its own.
  [[nodiscard]] Node* nodes(std::size_t slot, unsigned field = 0) {
    return &nodes_[block(slot, field) * nodes_per_block];
  }
  [[nodiscard]] const Node* nodes(std::size_t slot, unsigned field = 0) const {
    return &nodes_[block(slot, field) * nodes_per_block];
  }
  [[nodiscard]] std::span<Node> all_nodes() { return nodes_; }
  [[nodiscard]] std::span<const Node> all_nodes() const { return nodes_; }
  /// Blocks of nodes of the slots that this rank owns, and the number of each.
  [[nodiscard]] std::size_t owned_blocks() const { return blocks_.owned + owned_further_; }
  [[nodiscard]] std::size_t owned_block(std::size_t i) const {
    return i < blocks_.owned ? i : slots() + (i - blocks_.owned);
  }
  [[nodiscard]] bool is_contact_block(std::size_t block) const {
    return !contact_slots_.empty() && (block >= slots() || contact_number_[block] != no_slot);
  }

  /// The contact slots, ascending: this rank's own first.
  [[nodiscard]] std::span<const std::uint32_t> contact_slots() const { return contact_slots_; }
  [[nodiscard]] std::size_t owned_contact_slots() const { return owned_contact_slots_; }
  /// Number of a slot in that list, or `no_slot`.
  [[nodiscard]] std::int32_t contact_number(std::size_t slot) const {
    return contact_slots_.empty() ? no_slot : contact_number_[slot];
  }
  /// Blocks of nodes of a slot: its own, then the further ones.
  [[nodiscard]] std::size_t node_blocks(std::size_t slot) const {
    return contact_number(slot) == no_slot ? 1 : static_cast<std::size_t>(std::popcount(fields_[slot]));
  }
  [[nodiscard]] std::size_t node_block(std::size_t slot, std::size_t i) const {
    return i == 0 ? slot : further_begin_[static_cast<std::size_t>(contact_number_[slot])] + i - 1;
  }
  /// Bit per field that reaches a slot, since `separate_fields`.
  [[nodiscard]] std::uint64_t fields(std::size_t slot) const { return fields_[slot]; }

  /// Sets every node to zero.
  void clear();

  /// Returns whether several ranks work on some block.
  [[nodiscard]] bool is_shared() const;
  /// Registers of the nodes that are communicated.
  enum class Part { first, both };
  /// Adds the contributions of this rank's particles to ghost nodes to the nodes of their owners. Collective.
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
  void borrow_from_owners(ContactValues& values);
  /// Replaces the owners' values by the largest of all ranks. Collective.
  void maximum_to_owners(ContactValues& values);
  /// Sets the bits of each slot on all ranks that work with it if any of them has. Collective.
  void join_bits_of_ranks(std::vector<std::uint64_t>& of_slot);
  void borrow_from_owners(SlotValues& values);
  void maximum_to_owners(SlotValues& values);

  /// A node beyond a mirror plane and its image inside, as indices into all_nodes().
  struct MirrorPair {
    std::uint32_t outside;
    std::uint32_t image;
  };
  static constexpr std::uint32_t no_node = static_cast<std::uint32_t>(-1);
  struct MirrorPlane {
    int face = 0;  ///< in the order of Geometry::boundary
    int axis = 0;
    Boundary kind = Boundary::symmetry;
    /// Pairs of fields that are continuous with their mirror images (`bond_at_planes`).
    std::vector<MirrorPair> pairs;
    std::vector<std::uint32_t> on_plane;
    /// Pairs of fields that are in contact with their mirror images.
    std::vector<MirrorPair> pairs_apart;
    std::vector<std::uint32_t> on_plane_apart;
    /// Inner nodes that particles may reach from beyond the plane: the images of some rank's `outside` nodes.
    std::vector<std::uint32_t> near;
    [[nodiscard]] double outward() const { return face % 2 == 0 ? -1.0 : 1.0; }
  };
  /// Sets the fields that are continuous with their images at the mirror planes: one bit per field for each
  /// face. By default all are, except at separating walls. Call before `bin`.
  void bond_at_planes(const std::array<std::uint64_t, 6>& fields);
  /// Returns whether a field is continuous with its image at a face.
  [[nodiscard]] bool is_bonded_at(std::size_t face, unsigned field) const {
    return geometry_.boundary[face] != Boundary::outflow && (bonded_[face] >> field & 1U) != 0;
  }
  /// Returns whether some field may be in contact with its image at a face.
  [[nodiscard]] bool is_apart_at(std::size_t face) const {
    return geometry_.boundary[face] != Boundary::outflow && ~bonded_[face] != 0;
  }
  /// Planes with the active nodes that they concern, in the order in which they are folded.
  [[nodiscard]] std::span<const MirrorPlane> mirror_planes() const { return planes_; }
  /// Returns whether a node belongs to a ghost block, or to one that mirror planes connect with a ghost
  /// block.
  [[nodiscard]] bool is_awaited(std::size_t node) const {
    if (awaited_.empty()) return false;
    const std::size_t block = node / nodes_per_block;
    return awaited_[block < slots() ? block : slot_of_further_[block - slots()]] != 0;
  }
  /// Returns whether `is_awaited` holds for any node.
  [[nodiscard]] bool awaits() const { return !awaited_.empty(); }
  /// Returns whether a node is an image: beyond a plane across which its field is continuous.
  [[nodiscard]] bool is_image(std::size_t node) const { return !outside_.empty() && outside_[node] != 0; }

  /// Slot of the block around a position, `no_slot` if there is none.
  [[nodiscard]] std::int32_t slot_at(const Vector3& position) const {
    const std::optional<BlockCoordinate> block = block_of(position);
    return block ? table_.find(*block) : no_slot;
  }

  [[nodiscard]] std::int32_t slot_of(const BlockCoordinate& block) const { return table_.find(block); }
  /// Block around a position: nothing for a position beyond the outer layer, or NaN.
  [[nodiscard]] std::optional<BlockCoordinate> block_of(const Vector3& position) const;

  [[nodiscard]] std::size_t forest_leaves() const { return forest_.leaves(); }
  [[nodiscard]] std::size_t adaptations() const { return adaptations_; }
  /// Changes whenever nodes change their place in all_nodes().
  [[nodiscard]] std::size_t layout() const { return layout_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] Lanes in_cells(const Vector3& position) const { return geometry_.in_cells(position); }
  bool look_up(std::span<const Vector3> position);
  bool locate(std::span<const Vector3> position, Stencil stencil);
  [[nodiscard]] std::int32_t slot_of_neighbour(std::size_t slot, Lanes in_cells) const;
  [[nodiscard]] std::vector<WantedBlock> wanted_blocks(std::span<const Vector3> position,
                                                       std::span<const Vector3> velocity, double lookahead,
                                                       Stencil stencil, const Work& work) const;
  template <class Function>
  void for_each_mirror_block(const BlockCoordinate& block, Function&& f) const;
  bool locate_guests(std::span<const Vector3> guests, Stencil stencil);
  void list_particles();
  void list_guests();
  void forget_runs();
  void lay_out_nodes();
  void find_mirror_nodes();
  void find_border();
  void set_apart();
  [[nodiscard]] std::uint32_t active_node(const std::array<std::int32_t, 3>& place, int field) const;
  [[nodiscard]] std::size_t block(std::size_t slot, unsigned field) const {
    if (contact_slots_.empty() || contact_number_[slot] == no_slot || (fields_[slot] >> field & 1U) == 0) {
      return slot;
    }
    const int before = std::popcount(fields_[slot] & ((std::uint64_t{1} << field) - 1));
    return before == 0 ? slot
                       : further_begin_[static_cast<std::size_t>(contact_number_[slot])] +
                             static_cast<std::size_t>(before) - 1;
  }
  /// Slots that a peer and this rank share, and which way what belongs to them travels.
  using SharedSlots = std::vector<std::uint32_t> BlockSet::Peer::*;
  /// Buffers, by peer, of messages under way.
  template <class Value>
  struct Messages {
    std::vector<std::vector<Value>> outgoing, incoming;
    std::vector<MPI_Request> requests;
    void wait() {
      if (requests.empty()) return;
      MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
      requests.clear();
    }
    Messages() = default;
    Messages(Messages&&) = default;
    Messages& operator=(Messages&&) = delete;
    ~Messages() { wait(); }  // all ranks have begun; none may write to what is gone
  };
  /// Calls pack(slot of `from`, buffer) and sends the buffers; size(slot) values of each slot.
  template <class Value, class Size, class Pack>
  void send(Messages<Value>& messages, int tag, SharedSlots from, SharedSlots to, Size&& size, Pack&& pack);
  /// Waits for the buffers and calls unpack(slot of `to`, buffer).
  template <class Value, class Size, class Unpack>
  void receive(Messages<Value>& messages, SharedSlots to, Size&& size, Unpack&& unpack);
  template <class Value, class Size, class Pack, class Unpack>
  void exchange(SharedSlots from, SharedSlots to, Size&& size, Pack&& pack, Unpack&& unpack);
  void send_nodes(Part part, SharedSlots from, SharedSlots to);
  template <class Combine>
  void receive_nodes(Part part, SharedSlots to, Combine&& combine);
  template <class Range, class Combine>
  void exchange_values(Range&& range, SharedSlots from, SharedSlots to, Combine&& combine);

  MPI_Comm communicator_;
  Geometry geometry_;       // with the shift
  Vector3 origin_;          // its lower corner without
  double foresight_ = 0.0;  // cells that shifts may move a stencil by
  Stencil stencil_;
  Forest forest_;
  BlockTable table_;
  std::vector<WantedBlock> wanted_;  // by the last adaptation
  BlockSet blocks_;
  std::vector<std::array<std::int32_t, 27>> neighbours_;
  std::vector<std::uint32_t> existing_;  // bit per neighbour
  std::vector<Lanes> corner_;            // of each slot, in cells
  std::vector<Node> nodes_;
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
  /// Slots in groups: single blocks, or where there are many, cubes of two by two by two. A thread works
  /// through a cube on its own: its blocks follow one another in memory, and so do their particles.
  struct SlotGroups {
    std::vector<std::uint32_t> slots, begin;  ///< begin: of each group, and the end
  };
  static constexpr std::size_t slots_for_cubes = 1024;
  /// By region, for each of eight colours: groups whose reaches do not overlap.
  std::array<std::array<SlotGroups, 8>, 2> apart_;
  std::vector<std::uint8_t> awaited_, border_;  // of each slot; empty without ghost blocks
  Messages<Lanes> node_messages_;
  std::vector<MirrorPlane> planes_;
  std::array<std::uint64_t, 6> bonded_{};  // bit per field, of each face
  std::vector<std::uint8_t> outside_;
  std::size_t adaptations_ = 0;
  std::size_t layout_ = 0;
  std::vector<std::uint8_t> field_;  // of each particle
  std::vector<std::uint8_t> field_of_guest_;
  std::vector<std::uint64_t> fields_;        // of each slot: bit per field that reaches it
  std::vector<std::uint8_t> meets_contact_;  // of each slot: is one of its neighbours a contact slot?
  std::vector<std::uint32_t> contact_slots_;
  std::vector<std::int32_t> contact_number_;    // of each slot
  std::vector<std::uint32_t> further_begin_;    // of each contact slot: its first further block
  std::vector<std::uint32_t> slot_of_further_;  // of each further block
  std::size_t owned_contact_slots_ = 0, owned_further_ = 0;
};

}  // namespace whipple::grid

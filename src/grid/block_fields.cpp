// SPDX-License-Identifier: BSD-3-Clause
// Where the nodes of the blocks lie: contact slots have a block per velocity field (docs/theory/contact.md,
// 2); and which of the nodes mirror planes concern.
#include <algorithm>

#include "src/grid/block_grid.hpp"
#include "src/grid/block_reach.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::grid {
namespace {

constexpr std::size_t most_nodes_ahead = (std::size_t{1} << 30) / sizeof(Node);

}  // namespace

void BlockGrid::separate_fields(Stencil stencil, const FieldPoints& particles, const FieldPoints& guests,
                                unsigned fields, bool everywhere) {
  field_.assign(particles.field.begin(), particles.field.end());
  field_of_guest_.assign(guests.field.begin(), guests.field.end());
  const std::uint64_t all = fields >= maximum_fields ? ~std::uint64_t{0} : (std::uint64_t{1} << fields) - 1;
  std::vector<std::uint64_t> present(slots(), everywhere ? all : 0);
  if (!everywhere) {
    // Most blocks have points of one field in and around them.
    std::vector<std::uint64_t> inside(slots(), 0), around(slots(), 0);
    parallel::for_each(slots(), [&](std::size_t s) {
      for (const std::uint32_t p : particles_in(s)) inside[s] |= std::uint64_t{1} << particles.field[p];
      for (const std::uint32_t p : guests_in(s)) inside[s] |= std::uint64_t{1} << guests.field[p];
    });
    parallel::for_each(slots(), [&](std::size_t s) {
      for (const std::int32_t n : neighbours_[s]) {
        if (n != no_slot) around[s] |= inside[static_cast<std::size_t>(n)];
      }
    });
    const auto may_meet = [&](std::size_t s) { return is_shared() || std::popcount(around[s]) > 1; };
    // Of each slot: the fields of its points that reach each of the blocks around.
    std::vector<std::array<std::uint64_t, 27>> reached(slots());
    parallel::for_each_uneven(slots(), [&](std::size_t s) {
      reached[s].fill(0);
      const auto counts = [&](std::int32_t n) {
        return n != no_slot && may_meet(static_cast<std::size_t>(n));
      };
      if (!std::ranges::any_of(neighbours_[s], counts)) return;
      const auto reach = [&](std::span<const std::uint32_t> members, const FieldPoints& points) {
        for (const std::uint32_t p : members) {
          const std::uint32_t touched =
              touched_neighbours(in_cells(points.position[p]) - corner_[s], stencil);
          for_each_bit(touched, [&](unsigned n) { reached[s][n] |= std::uint64_t{1} << points.field[p]; });
        }
      };
      reach(particles_in(s), particles);
      reach(guests_in(s), guests);
    });
    parallel::for_each(slots(), [&](std::size_t s) {
      if (!may_meet(s)) {
        present[s] = around[s];
        return;
      }
      for (std::size_t n = 0; n < 27; ++n) {
        const std::int32_t neighbour = neighbours_[s][n];
        if (neighbour != no_slot) present[s] |= reached[static_cast<std::size_t>(neighbour)][26 - n];
      }
    });
    join_bits_of_ranks(present);
  }
  if (present == fields_) return;
  fields_ = std::move(present);
  lay_out_nodes();
}

/// Numbers the blocks of nodes after `fields_` (none: one field).
void BlockGrid::lay_out_nodes() {
  ++layout_;
  contact_slots_.clear();
  contact_number_.assign(slots(), no_slot);
  further_begin_.clear();
  slot_of_further_.clear();
  owned_contact_slots_ = owned_further_ = 0;
  for (std::size_t s = 0; s < fields_.size(); ++s) {
    const int fields = std::popcount(fields_[s]);
    if (fields < 2) continue;
    contact_number_[s] = static_cast<std::int32_t>(contact_slots_.size());
    contact_slots_.push_back(static_cast<std::uint32_t>(s));
    further_begin_.push_back(static_cast<std::uint32_t>(slots() + slot_of_further_.size()));
    slot_of_further_.insert(slot_of_further_.end(), static_cast<std::size_t>(fields - 1),
                            static_cast<std::uint32_t>(s));
    if (s < blocks_.owned) {
      owned_contact_slots_ = contact_slots_.size();
      owned_further_ = slot_of_further_.size();
    }
  }
  meets_contact_.assign(contact_slots_.empty() ? 0 : slots(), 0);
  for (const std::uint32_t s : contact_slots_) {
    for (const std::int32_t neighbour : neighbours_[s]) {
      if (neighbour != no_slot) meets_contact_[static_cast<std::size_t>(neighbour)] = 1;
    }
  }
  const std::size_t nodes = (slots() + slot_of_further_.size()) * nodes_per_block;
  if (nodes > nodes_.capacity()) {
    std::vector<Node>().swap(nodes_);  // every step begins with clear nodes
    // Takes addresses, but memory only when it is reached, and then new pages.
    nodes_.reserve(nodes + std::min(3 * nodes, most_nodes_ahead));
  }
  nodes_.resize(nodes);
  find_mirror_nodes();
}

namespace {

/// Position of the n-th bit that is set.
int nth_bit(std::uint64_t bits, std::size_t n) {
  for (; n > 0; --n) bits &= bits - 1;
  return std::countr_zero(bits);
}

}  // namespace

void BlockGrid::bond_at_planes(const std::array<std::uint64_t, 6>& fields) {
  for (MirrorPlane& plane : planes_) {
    const auto face = static_cast<std::size_t>(plane.face);
    bonded_[face] = plane.kind == Boundary::separating ? 0 : fields[face];
  }
  lay_out_nodes();
}

void BlockGrid::find_mirror_nodes() {
  if (planes_.empty()) return;
  outside_.assign(nodes_.size(), 0);
  for (MirrorPlane& mirror : planes_) {
    for (auto* list : {&mirror.on_plane, &mirror.on_plane_apart, &mirror.near}) list->clear();
    for (auto* list : {&mirror.pairs, &mirror.pairs_apart}) list->clear();
    const auto axis = static_cast<std::size_t>(mirror.axis);
    const std::int32_t at = mirror.face % 2 == 0 ? 0 : geometry_.cells[axis];
    const std::int32_t outward = mirror.face % 2 == 0 ? -1 : 1, edge = block_.along(axis);
    for (std::size_t b = 0; b < nodes_.size() / nodes_per_block; ++b) {
      const std::size_t s = b < slots() ? b : slot_of_further_[b - slots()];
      const std::int32_t first = blocks_.coordinate[s][axis] * edge;
      const std::int32_t least_inside =
          std::min((at - first) * outward, (at - first - (edge - 1)) * outward);
      if (least_inside > mirror_reach) continue;  // a block inside the domain
      int field = -1;                             // of the block's nodes; -1: of no or any field
      if (contact_number(s) != no_slot) {
        field =
            nth_bit(fields_[s],
                    b < slots() ? 0 : b - further_begin_[static_cast<std::size_t>(contact_number(s))] + 1);
      } else if (!fields_.empty() && fields_[s] != 0) {
        field = nth_bit(fields_[s], 0);
      }
      const bool bonded = (bonded_[static_cast<std::size_t>(mirror.face)] >> std::max(field, 0) & 1U) != 0;
      std::vector<std::uint32_t>& on_plane = bonded ? mirror.on_plane : mirror.on_plane_apart;
      std::vector<MirrorPair>& pairs = bonded ? mirror.pairs : mirror.pairs_apart;
      for (int i = 0; i < nodes_per_block; ++i) {
        const std::array<int, 3> inside_block = block_.place(i);
        const std::int32_t along = blocks_.coordinate[s][axis] * edge + inside_block[axis];
        const auto index = static_cast<std::uint32_t>(b * nodes_per_block + static_cast<std::size_t>(i));
        if (along == at) on_plane.push_back(index);
        const std::int32_t inside = (at - along) * outward;
        if (inside > 0 && inside <= mirror_reach) mirror.near.push_back(index);
        if (inside >= 0) continue;
        if (bonded) outside_[index] = 1;
        std::array<std::int32_t, 3> place{};
        for (std::size_t a = 0; a < 3; ++a)
          place[a] = blocks_.coordinate[s][a] * block_.along(a) + inside_block[a];
        place[axis] = 2 * at - along;
        const std::uint32_t image = active_node(place, field);
        // Without an active image no particle reaches so far beyond the plane: its stencil is symmetric.
        if (image != no_node) pairs.push_back({index, image});
      }
    }
  }
}

/// Determines the border slots: values that other ranks await are complete once the slots around them have
/// contributed, and mirror planes have been folded onto them. (While all fields share the nodes, the planes
/// connect at least as many slots as later.)
void BlockGrid::find_border() {
  awaited_.clear();
  border_.clear();
  if (blocks_.owned == slots()) return;
  awaited_.assign(slots(), 0);
  std::fill(awaited_.begin() + static_cast<std::ptrdiff_t>(blocks_.owned), awaited_.end(), std::uint8_t{1});
  for (bool grown = true; grown;) {
    grown = false;
    for (const MirrorPlane& plane : planes_) {
      for (const auto* pairs : {&plane.pairs, &plane.pairs_apart}) {
        for (const MirrorPair& pair : *pairs) {
          std::uint8_t& outside = awaited_[pair.outside / nodes_per_block];
          std::uint8_t& image = awaited_[pair.image / nodes_per_block];
          if (outside == image) continue;
          outside = image = 1;
          grown = true;
        }
      }
    }
  }
  border_.assign(slots(), 0);
  for (std::size_t s = 0; s < slots(); ++s) {
    for (const std::int32_t neighbour : neighbours_[s]) {
      if (neighbour != no_slot && awaited_[static_cast<std::size_t>(neighbour)] != 0) border_[s] = 1;
    }
  }
}

/// Index of a field's node at a place of the grid; `no_node` if its block is not active or not reached by the
/// field (-1: by whatever field is there).
std::uint32_t BlockGrid::active_node(const std::array<std::int32_t, 3>& place, int field) const {
  BlockCoordinate coordinate{};
  for (std::size_t a = 0; a < 3; ++a) {
    const int edge = block_.along(a);
    if (place[a] < -edge) return no_node;
    coordinate[a] = (place[a] + edge) / edge - 1;  // floor for >= -edge
  }
  const std::int32_t found = table_.find(coordinate);
  if (found == no_slot) return no_node;
  const auto slot = static_cast<std::size_t>(found);
  std::size_t of_field = slot;
  if (field >= 0 && fields_[slot] != 0) {
    if ((fields_[slot] >> field & 1U) == 0) return no_node;
    of_field = block(slot, static_cast<unsigned>(field));
  }
  const int in_block =
      block_.node(place[0] - coordinate[0] * block_.edge, place[1] - coordinate[1] * block_.edge,
                  place[2] - coordinate[2] * block_.edge_z);
  return static_cast<std::uint32_t>(of_field * nodes_per_block + static_cast<std::size_t>(in_block));
}

}  // namespace whipple::grid

// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/node_store.hpp"

#include <algorithm>

#include "src/core/parallel/threads.hpp"

namespace whipple::grid {
namespace {

constexpr std::size_t most_nodes_ahead = (std::size_t{1} << 30) / sizeof(Node);

}  // namespace

NodeStore::NodeStore(const Geometry& geometry, MPI_Comm communicator)
    : VelocityFields(geometry, communicator) {
  for (int face = 0; face < 6; ++face) {
    const Boundary boundary = geometry.boundary[static_cast<std::size_t>(face)];
    if (boundary == Boundary::outflow) continue;
    MirrorPlane plane;
    plane.face = face;
    plane.axis = face / 2;
    plane.kind = boundary;
    planes_.push_back(std::move(plane));
    bonded_[static_cast<std::size_t>(face)] = lets_part(boundary) ? FieldSet() : FieldSet::from(0);
    set_apart_at(static_cast<std::size_t>(face), lets_part(boundary));
  }
  std::ranges::stable_sort(planes_, {}, [](const MirrorPlane& plane) { return lets_part(plane.kind); });
}

void NodeStore::lay_out_nodes() {
  ++layout_;
  number_blocks();
  const std::size_t nodes = block_count() * nodes_per_block;
  if (nodes > nodes_.capacity()) {
    std::vector<Node>().swap(nodes_);  // every step begins with cleared nodes
    // Reserves addresses only; the system provides memory on first access, as new pages.
    nodes_.reserve(nodes + std::min(3 * nodes, most_nodes_ahead));
  }
  nodes_.resize(nodes);
  find_mirror_nodes();
}

void NodeStore::clear() {
  parallel::for_each(nodes_.size() / nodes_per_block, [&](std::size_t b) {
    std::fill_n(&nodes_[b * nodes_per_block], nodes_per_block, Node{{broadcast(0.0), broadcast(0.0)}});
  });
}

void NodeStore::bond_at_planes(const std::array<FieldSet, 6>& fields) {
  for (MirrorPlane& plane : planes_) {
    const auto face = static_cast<std::size_t>(plane.face);
    bonded_[face] = lets_part(plane.kind) ? FieldSet() : fields[face];
    set_apart_at(face, !bonded_[face].is_full());
  }
  lay_out_nodes();
}

Vector3 NodeStore::position_of_node(std::size_t node) const {
  const std::array<std::int32_t, 3> place = place_of_node(node);
  const Geometry& of_level = geometry_of_node(node);
  return of_level.lower + of_level.cell_size * Vector3(place[0], place[1], place[2]);
}

std::array<std::int32_t, 3> NodeStore::place_of_node(std::size_t node) const {
  const BlockCoordinate& block = coordinate(slot_of_block(node / nodes_per_block));
  const std::array<int, 3> inside_block = block_shape().place(static_cast<int>(node % nodes_per_block));
  std::array<std::int32_t, 3> place{};
  for (std::size_t a = 0; a < 3; ++a) place[a] = block[a] * block_shape().along(a) + inside_block[a];
  return place;
}

void NodeStore::find_mirror_nodes() {
  if (planes_.empty()) return;
  outside_.assign(nodes_.size(), 0);
  for (MirrorPlane& mirror : planes_) {
    for (auto* list : {&mirror.on_plane, &mirror.on_plane_apart, &mirror.near}) list->clear();
    for (auto* list : {&mirror.pairs, &mirror.pairs_apart}) list->clear();
    const auto axis = static_cast<std::size_t>(mirror.axis);
    const std::int32_t outward = mirror.face % 2 == 0 ? -1 : 1, edge = block_shape().along(axis);
    for (std::size_t b = 0; b < nodes_.size() / nodes_per_block; ++b) {
      const BlockCoordinate& block = coordinate(slot_of_block(b));
      const std::int32_t at = mirror.face % 2 == 0 ? 0 : geometry(block).cells[axis];
      const std::int32_t first = block[axis] * edge;
      const std::int32_t least_inside = std::min((at - first) * outward, (at - first - (edge - 1)) * outward);
      if (least_inside > mirror_reach) continue;  // far inside the domain
      const int field = field_of_block(b);
      const bool bonded =
          bonded_[static_cast<std::size_t>(mirror.face)].contains(static_cast<unsigned>(std::max(field, 0)));
      std::vector<std::uint32_t>& on_plane = bonded ? mirror.on_plane : mirror.on_plane_apart;
      std::vector<MirrorPair>& pairs = bonded ? mirror.pairs : mirror.pairs_apart;
      for (int i = 0; i < nodes_per_block; ++i) {
        const std::array<int, 3> inside_block = block_shape().place(i);
        const std::int32_t along = block[axis] * edge + inside_block[axis];
        const auto index = static_cast<std::uint32_t>(b * nodes_per_block + static_cast<std::size_t>(i));
        if (along == at) on_plane.push_back(index);
        const std::int32_t inside = (at - along) * outward;
        if (inside > 0 && inside <= mirror_reach) mirror.near.push_back(index);
        if (inside >= 0) continue;
        if (bonded) outside_[index] = 1;
        std::array<std::int32_t, 3> place = place_of_node(index);
        place[axis] = 2 * at - along;
        const std::uint32_t image = active_node(block.level, place, field);
        // Without an active image no particle reaches this far beyond the plane, since its stencil is symmetric.
        if (image != no_node) pairs.push_back({index, image});
      }
    }
  }
}

void NodeStore::find_border() {
  awaited_.clear();
  border_.clear();
  if (owned_slots() == slots()) return;
  awaited_.assign(slots(), 0);
  std::fill(awaited_.begin() + static_cast<std::ptrdiff_t>(owned_slots()), awaited_.end(), std::uint8_t{1});
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
    for (const std::int32_t neighbour : neighbours(s)) {
      if (neighbour != no_slot && awaited_[static_cast<std::size_t>(neighbour)] != 0) border_[s] = 1;
    }
  }
}

/// Returns the index of a field's node at a position of the grid; `no_node` if its block is not active or not reached
/// by the field (-1: any field).
std::uint32_t NodeStore::active_node(Level level, const std::array<std::int32_t, 3>& place, int field) const {
  BlockCoordinate block{{}, level};
  for (std::size_t a = 0; a < 3; ++a) {
    const int edge = block_shape().along(a);
    if (place[a] < -edge) return no_node;
    block[a] = (place[a] + edge) / edge - 1;  // floor for >= -edge
  }
  const std::int32_t found = slot_of(block);
  if (found == no_slot) return no_node;
  const auto slot = static_cast<std::size_t>(found);
  if (field >= 0 && !reaches(slot, static_cast<unsigned>(field))) return no_node;
  const std::size_t of_field = field < 0 ? slot : block_of_field(slot, static_cast<unsigned>(field));
  const BlockShape shape = block_shape();
  const int in_block = shape.node(place[0] - block[0] * shape.edge, place[1] - block[1] * shape.edge,
                                  place[2] - block[2] * shape.edge_z);
  return static_cast<std::uint32_t>(of_field * nodes_per_block + static_cast<std::size_t>(in_block));
}

}  // namespace whipple::grid

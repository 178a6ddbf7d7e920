// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/grid/node.hpp"
#include "src/grid/velocity_fields.hpp"

namespace whipple::grid {

/// Stores the nodes of all blocks and the linear constraints on them: the nodes that mirror planes connect.
class NodeStore : public VelocityFields {
 public:
  /// Returns the nodes of a slot for a field: those of the slot itself where the field has no separate nodes.
  [[nodiscard]] Node* nodes(std::size_t slot, unsigned field = 0) {
    return &nodes_[block_of_field(slot, field) * nodes_per_block];
  }
  [[nodiscard]] const Node* nodes(std::size_t slot, unsigned field = 0) const {
    return &nodes_[block_of_field(slot, field) * nodes_per_block];
  }
  [[nodiscard]] std::span<Node> all_nodes() { return nodes_; }
  [[nodiscard]] std::span<const Node> all_nodes() const { return nodes_; }
  /// Returns the number of a node of its level along each direction, from the lower corner of the domain.
  [[nodiscard]] std::array<std::int32_t, 3> place_of_node(std::size_t node) const;
  /// Returns the geometry of its level.
  [[nodiscard]] const Geometry& geometry_of_node(std::size_t node) const {
    return geometry(slot_of_block(node / nodes_per_block));
  }
  /// Returns its position: the corner plus these times the size of its cells.
  [[nodiscard]] Vector3 position_of_node(std::size_t node) const;
  /// Sets every node to zero.
  void clear();
  /// Returns a number that changes whenever nodes change their position in all_nodes().
  [[nodiscard]] std::size_t layout() const { return layout_; }

  /// Sets the fields that are continuous with their images at the mirror planes: one bit per field for each
  /// face. By default all are, except at walls from which material may part. Call before `bin`.
  void bond_at_planes(const std::array<FieldSet, 6>& fields);
  /// Returns whether a field is continuous with its image at a face.
  [[nodiscard]] bool is_bonded_at(std::size_t face, unsigned field) const {
    return geometry().boundary[face] != Boundary::outflow && bonded_[face].contains(field);
  }
  /// Returns whether some field may be in contact with its image at a face.
  [[nodiscard]] bool is_apart_at(std::size_t face) const {
    return geometry().boundary[face] != Boundary::outflow && !bonded_[face].is_full();
  }
  /// Returns the planes with the active nodes that they affect, in the order in which they are folded.
  [[nodiscard]] std::span<const MirrorPlane> mirror_planes() const { return planes_; }
  /// Returns whether a node belongs to a ghost block, or to a block that mirror planes connect with a ghost block.
  [[nodiscard]] bool is_awaited(std::size_t node) const {
    if (awaited_.empty()) return false;
    const std::size_t block = node / nodes_per_block;
    return awaited_[slot_of_block(block)] != 0;
  }
  /// Returns whether `is_awaited` holds for any node.
  [[nodiscard]] bool awaits() const { return !awaited_.empty(); }
  /// Returns whether a node is an image: beyond a plane across which its field is continuous.
  [[nodiscard]] bool is_image(std::size_t node) const { return !outside_.empty() && outside_[node] != 0; }

 protected:
  NodeStore(const Geometry& geometry, MPI_Comm communicator);
  /// Allocates the nodes of all blocks and fields.
  void lay_out_nodes();
  /// Determines the border slots: values that other ranks await are complete when the neighbouring slots have
  /// contributed and mirror planes have been folded onto them. (As long as all fields share the nodes, the planes
  /// connect at least as many slots as with separate fields.)
  void find_border();
  [[nodiscard]] bool is_at_border(std::size_t slot) const { return !border_.empty() && border_[slot] != 0; }

 private:
  void find_mirror_nodes();
  [[nodiscard]] std::uint32_t active_node(Level level, const std::array<std::int32_t, 3>& place,
                                          int field) const;

  std::vector<Node> nodes_;
  std::size_t layout_ = 0;
  std::vector<MirrorPlane> planes_;
  std::array<FieldSet, 6> bonded_{};  // for each face
  // Of each node: 1 if it is an image across a plane where its field is continuous
  std::vector<std::uint8_t> outside_;
  std::vector<std::uint8_t> awaited_, border_;  // of each slot; empty without ghost blocks
};

}  // namespace whipple::grid

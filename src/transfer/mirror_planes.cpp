// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/mirror_planes.hpp"

#include <algorithm>
#include <span>

#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::transfer {
namespace {

using grid::BlockGrid;
using grid::Node;

/// Sign of the components under reflection, for a vector in lanes 1 to 3 (P2G form) or 0 to 2 (velocity
/// form).
Lanes reflection(const grid::MirrorPlane& plane, int first_lane) {
  Lanes sign = broadcast(1.0);
  for (int c = 0; c < 3; ++c) {
    if (plane.kind == grid::Boundary::no_slip || c == plane.axis) sign[first_lane + c] = -1.0;
  }
  return sign;
}

/// Folds node j: the image of a particle contributes to j as the particle does to the mirror node of j, with the
/// reflected vector. Only real particles were transferred, so their contributions beyond the plane are folded to
/// the inside.
void fold_node(Node& image, const Node& outside, Lanes sign, BlockGrid::Part part) {
  image.registers.first += sign * outside.registers.first;
  if (part == BlockGrid::Part::both) image.registers.second += sign * outside.registers.second;
}

/// On a plane a vector is its own image: the reversed components vanish. Mass and force would double alike.
void restrict_to_plane(Node& node, Lanes sign, BlockGrid::Part part) {
  const Lanes keep = 0.5 * (broadcast(1.0) + sign);
  node.registers.first *= keep;
  if (part == BlockGrid::Part::both) node.registers.second *= keep;
}

/// Returns whether the step of a node is exactly that of the contributions of this rank's particles alone.
bool is_result_of(const Node& node, const Node& brought, Lanes damping, double dt) {
  const double mass = brought.sums.mass();
  const Lanes velocity = brought.sums.mass_and_momentum / mass,
              increment = brought.sums.sound_and_force * (dt / mass);
  for (int c = 0; c < 3; ++c) {
    if (velocity[c + 1] != node.motion.velocity_and_relaxation[c] ||
        increment[c + 1] + damping[c] != node.motion.increment_and_heat[c])
      return false;
  }
  return true;
}

}  // namespace

void MirrorPlanes::find_nodes(const BlockGrid& grid) {
  if (layout_ == grid.layout()) return;
  layout_ = grid.layout();
  // Four times its number, plus 1 if it is only an image, or 3 if it is only in a contact slot
  std::vector<std::uint64_t> nodes;
  const auto add = [&](std::size_t node, std::uint64_t kind) {
    nodes.push_back(4 * static_cast<std::uint64_t>(node) + kind);
  };
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    // Material in contact with its image as with another body may not touch it yet.
    for (const grid::MirrorPair& pair : plane.pairs_apart) add(pair.outside, 1);
    for (const std::uint32_t on_plane : plane.on_plane_apart) add(on_plane, 1);
    for (const grid::MirrorPair& pair : plane.pairs) add(pair.outside, 0);
    // Another rank may be the one that folds onto them.
    for (const std::uint32_t near : plane.near) add(near, 1);
    for (const std::uint32_t on_plane : plane.on_plane) add(on_plane, 0);
  }
  for (std::size_t block = 0; also_contact_ && block < grid.all_nodes().size() / grid::nodes_per_block;
       ++block) {
    if (!grid.is_contact_block(block)) continue;
    for (std::size_t i = 0; i < grid::nodes_per_block; ++i) add(block * grid::nodes_per_block + i, 3);
  }
  std::ranges::sort(nodes);  // nodes that are more than an image come first
  nodes_.clear();
  kind_.clear();
  for (const std::uint64_t entry : nodes) {
    const auto node = static_cast<std::uint32_t>(entry / 4);
    if (!nodes_.empty() && nodes_.back() == node) continue;
    nodes_.push_back(node);
    kind_.push_back({.at_plane = entry % 4 < 3, .may_be_unchanged = entry % 4 > 0});
  }
}

void MirrorPlanes::remember(const BlockGrid& grid, Nodes which) {
  find_nodes(grid);
  before_.resize(nodes_.size());
  parallel::for_each(nodes_.size(), [&](std::size_t i) {
    if (is_among(grid, nodes_[i], which)) before_[i] = grid.all_nodes()[nodes_[i]];
  });
}

/// Folds every plane and restricts the nodes on it, where material is continuous with its image.
void MirrorPlanes::fold(BlockGrid& grid, Nodes which, BlockGrid::Part part) {
  const std::span<Node> nodes = grid.all_nodes();
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    const Lanes sign = reflection(plane, 1);
    parallel::for_each(plane.pairs.size(), [&](std::size_t i) {
      const grid::MirrorPair& pair = plane.pairs[i];
      if (!is_among(grid, pair.image, which)) return;
      fold_node(nodes[pair.image], nodes[pair.outside], sign, part);
    });
  }
  // After all folds, because between two planes one cell apart each folds onto the nodes of the other.
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    const Lanes sign = reflection(plane, 1);
    parallel::for_each(plane.on_plane.size(), [&](std::size_t i) {
      const std::uint32_t node = plane.on_plane[i];
      if (is_among(grid, node, which)) restrict_to_plane(nodes[node], sign, part);
    });
  }
}

/// Velocities beyond the planes are the reflected ones; reverse order, so that corners come out right.
void MirrorPlanes::copy_back(BlockGrid& grid, Nodes which) {
  const std::span<Node> nodes = grid.all_nodes();
  const auto planes = grid.mirror_planes();
  for (std::size_t n = planes.size(); n-- > 0;) {
    const grid::MirrorPlane& plane = planes[n];
    const Lanes sign = reflection(plane, 0);
    parallel::for_each(plane.pairs.size(), [&](std::size_t i) {
      const grid::MirrorPair& pair = plane.pairs[i];
      if (!is_among(grid, pair.image, which)) return;
      nodes[pair.outside].registers.first = sign * nodes[pair.image].registers.first;
      nodes[pair.outside].registers.second = sign * nodes[pair.image].registers.second;
    });
  }
}

/// In reverse order, as `copy_back`.
void MirrorPlanes::copy_to_images(const BlockGrid& grid, std::span<Lanes> of_node) {
  const auto planes = grid.mirror_planes();
  for (std::size_t n = planes.size(); n-- > 0;) {
    const Lanes sign = reflection(planes[n], 0);
    for (const grid::MirrorPair& pair : planes[n].pairs) of_node[pair.outside] = sign * of_node[pair.image];
  }
}

/// Returns the increment of the velocity of a remembered node by local damping, m/s.
Lanes MirrorPlanes::damping_at(std::size_t i) const {
  return damping_.empty() ? broadcast(0.0) : damping_[nodes_[i]];
}

Vector3 MirrorPlanes::damping_impulse(const BlockGrid& grid, Nodes which) const {
  Lanes impulse = broadcast(0.0);
  for (std::size_t i = 0; !damping_.empty() && i < nodes_.size(); ++i) {
    if (kind_[i].at_plane && is_among(grid, nodes_[i], which))
      impulse += before_[i].sums.mass() * damping_[nodes_[i]];
  }
  return {impulse[0], impulse[1], impulse[2]};
}

/// Returns the momentum that planes and contact gave to the real particles at a node: equation 3.6 of
/// docs/theory/mpm.md.
Lanes MirrorPlanes::impulse_at(const BlockGrid& grid, std::size_t i, double dt) const {
  const Node& real = before_[i];
  const Node& node = grid.all_nodes()[nodes_[i]];
  const double mass = real.sums.mass();
  // A node that received nothing in the fold is not changed by the planes: only its round-off would count.
  // (What arrives may be a force without any mass to speak of, at the edge of a kernel.)
  if (kind_[i].may_be_unchanged && is_result_of(node, real, damping_at(i), dt)) return broadcast(0.0);
  const Vector3 momentum = real.sums.momentum(), force = real.sums.force();
  const Lanes p = {momentum[0], momentum[1], momentum[2], 0.0}, f = {force[0], force[1], force[2], 0.0};
  const Lanes v = node.motion.velocity_and_relaxation;
  return mass * (node.motion.increment_and_heat - damping_at(i)) - dt * f -
         node.motion.relaxation() * (p - mass * v);
}

Vector3 MirrorPlanes::impulse(const BlockGrid& grid, Nodes which, double dt) const {
  Lanes impulse = broadcast(0.0);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!kind_[i].at_plane || !is_among(grid, nodes_[i], which)) continue;
    impulse += impulse_at(grid, i, dt);
  }
  return {impulse[0], impulse[1], impulse[2]};
}

}  // namespace whipple::transfer

// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/grid_update.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::transfer {
namespace {

using grid::BlockGrid;
using grid::Node;

constexpr double no_mass = 1e-300;  // kg; below it momentum / mass may overflow

/// Sign of the components under reflection, for a vector in lanes 1 to 3 (P2G form) or 0 to 2 (velocity
/// form).
Lanes reflection(const grid::MirrorPlane& plane, int first_lane) {
  Lanes sign = broadcast(1.0);
  for (int c = 0; c < 3; ++c) {
    if (plane.kind == grid::Boundary::no_slip || c == plane.axis) sign[first_lane + c] = -1.0;
  }
  return sign;
}

/// The image of a particle brings to node j what the particle brings to the mirror node of j, with the
/// reflected vector. Real particles only were transferred, so what they brought beyond the plane is folded to
/// the inside.
void fold(Node& image, const Node& outside, Lanes sign, bool with_forces) {
  image.registers.first += sign * outside.registers.first;
  if (with_forces) image.registers.second += sign * outside.registers.second;
}

/// On a plane a vector is its own image: the reversed components vanish. Mass and force would double alike.
void restrict_to_plane(Node& node, Lanes sign, bool with_forces) {
  const Lanes keep = 0.5 * (broadcast(1.0) + sign);
  node.registers.first *= keep;
  if (with_forces) node.registers.second *= keep;
}

/// Returns whether the step of a node is exactly that of the contributions of this rank's particles alone.
bool is_result_of(const Node& node, const Node& brought, double dt) {
  const double mass = brought.sums.mass();
  const Lanes velocity = brought.sums.mass_and_momentum / mass,
              increment = brought.sums.sound_and_force * (dt / mass);
  for (int c = 0; c < 3; ++c) {
    if (velocity[c + 1] != node.motion.velocity_and_relaxation[c] ||
        increment[c + 1] != node.motion.increment_and_heat[c])
      return false;
  }
  return true;
}

/// beta of the nodes of a block, four at a time; 0 where there is no mass, and where nodes of elements made
/// the sum of the sound speeds negative (docs/theory/afemp.md, 2).
std::array<double, grid::nodes_per_block> relaxation_of(const Node* nodes, const Relaxation& relaxation,
                                                        double rate) {
  std::array<double, grid::nodes_per_block> beta;
  if (relaxation.fixed >= 0.0) {
    beta.fill(relaxation.fixed);
    return beta;
  }
  for (std::size_t i = 0; i < beta.size(); i += 4) {
    const Node* n = nodes + i;
    const Lanes mass = {n[0].sums.mass(), n[1].sums.mass(), n[2].sums.mass(), n[3].sums.mass()};
    const Lanes carried = {n[0].sums.sound(), n[1].sums.sound(), n[2].sums.sound(), n[3].sums.sound()};
    const LanesMask massive = mass >= no_mass;
    Lanes of_four{};
    if (any(massive)) {
      const Lanes sound_speed = maximum(carried, Lanes{}) / select(massive, mass, broadcast(1.0));
      of_four = select(massive, -exp_minus_1(-rate * sound_speed), Lanes{});
    }
    store(&beta[i], of_four);
  }
  return beta;
}

}  // namespace

void GridUpdate::remember_nodes_at_planes(const BlockGrid& grid) {
  if (at_planes_of_ == grid.layout()) return;
  at_planes_of_ = grid.layout();
  std::vector<std::uint64_t> nodes;  // twice its number, and 1 if it is only an image
  const auto add = [&](std::uint32_t node, std::uint64_t only_image) {
    nodes.push_back(2 * static_cast<std::uint64_t>(node) + only_image);
  };
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    // Where material meets its image as another body it may not do so yet.
    for (const grid::MirrorPair& pair : plane.pairs_apart) add(pair.outside, 1);
    for (const std::uint32_t on_plane : plane.on_plane_apart) add(on_plane, 1);
    for (const grid::MirrorPair& pair : plane.pairs) add(pair.outside, 0);
    // Another rank may be the one that folds onto them.
    for (const std::uint32_t near : plane.near) add(near, 1);
    for (const std::uint32_t on_plane : plane.on_plane) add(on_plane, 0);
  }
  std::ranges::sort(nodes);  // what is more than an image comes first
  at_planes_.clear();
  may_be_unchanged_.clear();
  for (const std::uint64_t entry : nodes) {
    const auto node = static_cast<std::uint32_t>(entry / 2);
    if (!at_planes_.empty() && at_planes_.back() == node) continue;
    at_planes_.push_back(node);
    may_be_unchanged_.push_back(static_cast<std::uint8_t>(entry % 2));
  }
}

void GridUpdate::remember_content(const BlockGrid& grid, Nodes which) {
  remember_nodes_at_planes(grid);
  before_.resize(at_planes_.size());
  parallel::for_each(at_planes_.size(), [&](std::size_t i) {
    if (among(grid, at_planes_[i], which)) before_[i] = grid.all_nodes()[at_planes_[i]];
  });
}

/// Folds every plane and restricts the nodes on it, where material is one with its image.
void GridUpdate::fold_planes(BlockGrid& grid, Nodes which, bool with_forces) {
  const std::span<Node> nodes = grid.all_nodes();
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    const Lanes sign = reflection(plane, 1);
    parallel::for_each(plane.pairs.size(), [&](std::size_t i) {
      const grid::MirrorPair& pair = plane.pairs[i];
      if (!among(grid, pair.image, which)) return;
      fold(nodes[pair.image], nodes[pair.outside], sign, with_forces);
    });
  }
  // After all folds, because between two planes one cell apart each folds onto the nodes of the other.
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    const Lanes sign = reflection(plane, 1);
    parallel::for_each(plane.on_plane.size(), [&](std::size_t i) {
      const std::uint32_t node = plane.on_plane[i];
      if (among(grid, node, which)) restrict_to_plane(nodes[node], sign, with_forces);
    });
  }
}

/// Velocities beyond the planes are the reflected ones; reverse order, so that corners come out right.
void GridUpdate::copy_back(BlockGrid& grid, Nodes which) {
  const std::span<Node> nodes = grid.all_nodes();
  const auto planes = grid.mirror_planes();
  for (std::size_t n = planes.size(); n-- > 0;) {
    const grid::MirrorPlane& plane = planes[n];
    const Lanes sign = reflection(plane, 0);
    parallel::for_each(plane.pairs.size(), [&](std::size_t i) {
      const grid::MirrorPair& pair = plane.pairs[i];
      if (!among(grid, pair.image, which)) return;
      nodes[pair.outside].registers.first = sign * nodes[pair.image].registers.first;
      nodes[pair.outside].registers.second = sign * nodes[pair.image].registers.second;
    });
  }
}

/// Contact with the images, then the nodes beyond the planes where material is one with its image.
void GridUpdate::meet_images(BlockGrid& grid, Nodes which) {
  mirror_contact_.apply(grid, dt_, [&](std::uint32_t node) { return among(grid, node, which); });
  copy_back(grid, which);
  if (!mirror_contact_.made_heat()) return;
  for (std::size_t i = 0; i < at_planes_.size(); ++i) {
    if (!among(grid, at_planes_[i], which)) continue;
    contact_heat_ += before_[i].sums.mass() * mirror_contact_.heat_at(at_planes_[i]);
  }
}

/// Applies contact with mirror images again, to velocities computed from momenta.
void GridUpdate::meet_images_again(BlockGrid& grid, Nodes which) {
  mirror_contact_.apply_to_velocities(grid, [&](std::uint32_t node) { return among(grid, node, which); });
  copy_back(grid, which);
}

void GridUpdate::send(BlockGrid& grid, BlockGrid::Part part) {
  const bool with_forces = part == BlockGrid::Part::both;
  if (with_forces) remember_content(grid, Nodes::awaited);
  if (grid.awaits()) fold_planes(grid, Nodes::awaited, with_forces);
  grid.begin_sum_to_owners(part);
  sent_ = true;
}

/// Mass, momentum and perhaps force of all ranks on the nodes of this one, planes folded.
void GridUpdate::complete_sums(BlockGrid& grid, BlockGrid::Part part) {
  const bool with_forces = part == BlockGrid::Part::both;
  if (!sent_) send(grid, part);
  const Nodes which = sent_ ? Nodes::others : Nodes::all;
  if (with_forces) remember_content(grid, which);
  fold_planes(grid, which, with_forces);
  if (!sent_) grid.begin_sum_to_owners(part);
  sent_ = false;
  grid.finish_sum_to_owners(part);
}

NodeEnergies GridUpdate::solve_momentum(BlockGrid& grid, double dt, const Relaxation& relaxation) {
  const std::span<Node> nodes = grid.all_nodes();
  dt_ = dt;
  complete_sums(grid, BlockGrid::Part::both);
  mirror_contact_.lay_out(grid);
  const double rate = relaxation.kappa * dt / grid.geometry().cell_size;
  std::vector<NodeEnergies> of_block(grid.owned_blocks());
  parallel::for_each(grid.owned_blocks(), [&](std::size_t b) {
    const std::size_t block = grid.owned_block(b);
    const std::size_t first = block * grid::nodes_per_block;
    const double mass_kept =
        grid.is_contact_block(block) || mirror_contact_.concerns_block(block) ? 1.0 : 0.0;
    const std::array<double, grid::nodes_per_block> betas = relaxation_of(&nodes[first], relaxation, rate);
    for (std::size_t i = first; i < first + grid::nodes_per_block; ++i) {
      Node& node = nodes[i];
      const double mass = node.sums.mass();
      if (mass < no_mass || grid.is_image(i)) {
        node.registers = {broadcast(0.0), broadcast(0.0)};
        continue;
      }
      const double beta = betas[i - first];
      const Lanes velocity = node.sums.mass_and_momentum / mass;
      const Lanes increment = node.sums.sound_and_force * (dt / mass);
      const Lanes v = {velocity[1], velocity[2], velocity[3], beta},
                  d = {increment[1], increment[2], increment[3], mass_kept * mass};
      node.motion = {v, d};
      const Lanes advanced = v + d;
      of_block[b] += NodeEnergies{0.5 * mass * sum3(v * v), 0.5 * mass * sum3(advanced * advanced)};
    }
  });
  mirror_contact_.remember(grid);
  // Sums run in the order of the blocks, where empty blocks add zero: the same bits whatever blocks happen to
  // be active.
  NodeEnergies energy;
  for (const NodeEnergies& part : of_block) energy += part;
  return energy;
}

Vector3 GridUpdate::share_step(BlockGrid& grid) {
  mirror_contact_.tell_others(grid);
  grid.begin_borrow_from_owners(BlockGrid::Part::both);
  awaiting_ = Awaiting::step;
  meet_images(grid, Nodes::others);
  return wall_impulse(grid, Nodes::others);
}

/// Momentum that the planes gave to the real particles: equation 3.6 of docs/theory/mpm.md.
Vector3 GridUpdate::wall_impulse(const BlockGrid& grid, Nodes which) const {
  Lanes impulse = broadcast(0.0);
  for (std::size_t i = 0; i < at_planes_.size(); ++i) {
    if (!among(grid, at_planes_[i], which)) continue;
    const Node& real = before_[i];
    const Node& node = grid.all_nodes()[at_planes_[i]];
    const double mass = real.sums.mass();
    // A node that received nothing in the fold is not changed by the planes: only its round-off would count.
    // (What arrives may be a force without any mass to speak of, at the edge of a kernel.)
    if (may_be_unchanged_[i] != 0 && is_result_of(node, real, dt_)) continue;
    const Vector3 momentum = real.sums.momentum(), force = real.sums.force();
    const Lanes p = {momentum[0], momentum[1], momentum[2], 0.0}, f = {force[0], force[1], force[2], 0.0};
    const Lanes v = node.motion.velocity_and_relaxation;
    impulse += mass * node.motion.increment_and_heat - dt_ * f - node.motion.relaxation() * (p - mass * v);
  }
  return {impulse[0], impulse[1], impulse[2]};
}

void GridUpdate::solve_velocity(BlockGrid& grid) {
  const std::span<Node> nodes = grid.all_nodes();
  complete_sums(grid, BlockGrid::Part::first);
  mirror_contact_.lay_out(grid);
  parallel::for_each(grid.owned_blocks(), [&](std::size_t b) {
    const std::size_t block = grid.owned_block(b), begin = block * grid::nodes_per_block;
    const double mass_kept = mirror_contact_.concerns_block(block) ? 1.0 : 0.0;
    for (std::size_t i = begin; i < begin + grid::nodes_per_block; ++i) {
      Lanes& first = nodes[i].registers.first;  // mass and momentum, then velocity
      const double mass = first[0];
      if (mass < no_mass || grid.is_image(i)) {
        first = broadcast(0.0);
      } else {
        first = Lanes{first[1], first[2], first[3], 0.0} / mass;
        first[3] = mass_kept * mass;
      }
    }
  });
  grid.begin_borrow_from_owners(BlockGrid::Part::first);
  awaiting_ = Awaiting::velocity;
  meet_images_again(grid, Nodes::others);
}

Vector3 GridUpdate::receive(BlockGrid& grid) {
  const Awaiting awaited = std::exchange(awaiting_, Awaiting::nothing);
  if (awaited == Awaiting::nothing) return Vector3::Zero();
  const bool of_step = awaited == Awaiting::step;
  grid.finish_borrow_from_owners(of_step ? BlockGrid::Part::both : BlockGrid::Part::first);
  if (!grid.awaits()) return Vector3::Zero();
  if (!of_step) {
    meet_images_again(grid, Nodes::awaited);
    return Vector3::Zero();
  }
  meet_images(grid, Nodes::awaited);
  return wall_impulse(grid, Nodes::awaited);
}

}  // namespace whipple::transfer

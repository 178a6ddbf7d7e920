// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/local_damping.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "src/core/parallel/threads.hpp"
#include "src/transfer/mirror_planes.hpp"
#include "src/transfer/momentum.hpp"

namespace whipple::transfer {

using grid::BlockGrid;

namespace {

/// Describes how planes concern a node.
struct AtPlanes {
  bool near = false;   // its impulses count as those of planes
  bool apart = false;  // its material may be in contact with its image
};

AtPlanes at_planes(const BlockGrid& grid, std::size_t node, unsigned field) {
  const std::array<std::int32_t, 3> place = grid.place_of_node(node);
  AtPlanes at;
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    const auto axis = static_cast<std::size_t>(plane.axis);
    const std::int32_t position = plane.face % 2 == 0 ? 0 : grid.geometry_of_node(node).cells[axis];
    if (std::abs(place[axis] - position) > BlockGrid::mirror_reach) continue;
    at.near = true;
    at.apart = at.apart || !grid.is_bonded_at(static_cast<std::size_t>(plane.face), field);
  }
  return at;
}

}  // namespace

void LocalDamping::damp_slot(const BlockGrid& grid, std::size_t slot, double alpha, double dt) {
  const std::span<const grid::Node> nodes = grid.all_nodes();
  const std::size_t blocks = grid.node_blocks(slot);
  for (std::size_t i = 0; i < grid::nodes_per_block; ++i) {
    std::size_t bodies = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      if (nodes[grid.node_block(slot, b) * grid::nodes_per_block + i].sums.mass() >= no_mass) ++bodies;
    }
    if (bodies != 1) continue;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t block = grid.node_block(slot, b), n = block * grid::nodes_per_block + i;
      const grid::NodeSums& sums = nodes[n].sums;
      const double mass = sums.mass();
      if (mass < no_mass || grid.is_image(n)) continue;
      const AtPlanes at = at_planes(grid, n, grid.whole_of_block(block));
      if (at.apart) continue;
      const Lanes velocity = sums.mass_and_momentum / mass, increment = sums.sound_and_force * (dt / mass);
      const Lanes damping = (damping_factor(alpha, velocity, increment) - 1.0) * increment;
      increment_[n] = Lanes{damping[1], damping[2], damping[3], 0.0};
      damped_[slot].push_back({static_cast<std::uint32_t>(n), mass});
      if (!at.near) of_slot_[slot] += mass * Vector3(damping[1], damping[2], damping[3]);
    }
  }
}

void LocalDamping::find(BlockGrid& grid, double alpha, double dt) {
  increment_.assign(grid.all_nodes().size(), broadcast(0.0));
  damped_.resize(grid.owned_slots());
  of_slot_.assign(grid.owned_slots(), Vector3::Zero());
  parallel::for_each(grid.owned_slots(), [&](std::size_t slot) {
    damped_[slot].clear();
    damp_slot(grid, slot, alpha, dt);
  });
  impulse_.setZero();
  for (const Vector3& part : of_slot_) impulse_ += part;
  share(grid);
}

void LocalDamping::add(BlockGrid& grid) const {
  const std::span<grid::Node> nodes = grid.all_nodes();
  parallel::for_each(damped_.size(), [&](std::size_t slot) {
    for (const Damped& damped : damped_[slot])
      nodes[damped.node].motion.increment_and_heat += increment_[damped.node];
  });
}

/// Finds the increments of the nodes of other ranks and of the images beyond mirror planes.
void LocalDamping::share(BlockGrid& grid) {
  if (grid.is_shared()) {
    // Calls f(first node) for the blocks of nodes in the order of the slots.
    const auto for_each_block = [&](auto&& f) {
      for (std::size_t slot = 0; slot < grid.slots(); ++slot) {
        for (std::size_t b = 0; b < grid.node_blocks(slot); ++b)
          f(increment_.begin() +
            static_cast<std::ptrdiff_t>(grid.node_block(slot, b) * grid::nodes_per_block));
      }
    };
    shared_.begin.assign(1, 0);
    for (std::size_t slot = 0; slot < grid.slots(); ++slot) {
      shared_.begin.push_back(shared_.begin.back() +
                              static_cast<std::uint32_t>(grid.node_blocks(slot) * grid::nodes_per_block));
    }
    shared_.values.resize(shared_.begin.back());
    auto next = shared_.values.begin();
    for_each_block([&](auto first) { next = std::copy_n(first, grid::nodes_per_block, next); });
    grid.borrow_from_owners(shared_);
    auto from = shared_.values.cbegin();
    for_each_block([&](auto first) {
      std::copy_n(from, grid::nodes_per_block, first);
      from += grid::nodes_per_block;
    });
  }
  MirrorPlanes::copy_to_images(grid, increment_);
}

double LocalDamping::work(const BlockGrid& grid) const {
  const std::span<const grid::Node> nodes = grid.all_nodes();
  double work = 0.0;
  for (const std::vector<Damped>& of_slot : damped_) {
    for (const Damped& damped : of_slot) {
      const grid::NodeMotion& motion = nodes[damped.node].motion;
      work += damped.mass * sum3(increment_[damped.node] *
                                 (motion.velocity_and_relaxation + 0.5 * motion.increment_and_heat));
    }
  }
  return work;
}

}  // namespace whipple::transfer

// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/grid_update.hpp"

#include <utility>

namespace whipple::contact {

using grid::BlockGrid;
using transfer::Nodes;

/// Applies contact with the mirror images, then sets the nodes beyond the planes at which the material is continuous
/// with its image.
void GridUpdate::meet_images(BlockGrid& grid, Nodes which) {
  mirror_contact_.apply(grid, dt_, which);
  transfer::MirrorPlanes::copy_back(grid, which);
  if (!mirror_contact_.made_heat()) return;
  planes_.add_by_mass(
      grid, which, [&](std::uint32_t node) { return mirror_contact_.heat_at(node); }, contact_heat_);
}

/// Applies contact with mirror images again, to velocities computed from momenta.
void GridUpdate::meet_images_again(BlockGrid& grid, Nodes which) {
  mirror_contact_.apply_to_velocities(grid, which);
  transfer::MirrorPlanes::copy_back(grid, which);
}

/// Returns the impulse of planes and walls in the step, after telling that of every node.
Vector3 GridUpdate::impulse(const BlockGrid& grid, Nodes which) const {
  if (watch_) {
    planes_.for_each_impulse(grid, which, dt_, [&](std::uint32_t node, Lanes impulse) {
      watch_(node, {impulse[0], impulse[1], impulse[2]});
    });
  }
  return planes_.impulse(grid, which, dt_);
}

void GridUpdate::send(BlockGrid& grid, BlockGrid::Part part) {
  if (part == BlockGrid::Part::both) planes_.remember(grid, Nodes::awaited);
  if (grid.awaits()) transfer::MirrorPlanes::fold(grid, Nodes::awaited, part);
  grid.begin_sum_to_owners(part);
  sent_ = true;
}

/// Completes mass, momentum and, for both registers, force at this rank's nodes: folds at mirror planes and adds the
/// contributions of all ranks.
void GridUpdate::complete_sums(BlockGrid& grid, BlockGrid::Part part) {
  if (!sent_) send(grid, part);
  sent_ = false;
  if (part == BlockGrid::Part::both) planes_.remember(grid, Nodes::others);
  transfer::MirrorPlanes::fold(grid, Nodes::others, part);
  grid.finish_sum_to_owners(part);
}

void GridUpdate::solve_momentum(BlockGrid& grid, double dt, const transfer::Relaxation& relaxation,
                                double damping) {
  dt_ = dt;
  complete_sums(grid, BlockGrid::Part::both);
  damping_.clear();
  if (damping > 0.0) damping_.find(grid, damping, dt);
  planes_.set_damping(damping_.increments());
  mirror_contact_.lay_out(grid);
  transfer::solve_momentum(grid, dt, relaxation, [&](std::size_t block) {
    return grid.is_contact_block(block) || mirror_contact_.concerns_block(block);
  });
  if (damping > 0.0) damping_.add(grid);
  mirror_contact_.remember(grid);
}

GridUpdate::Damped GridUpdate::take_damping(const BlockGrid& grid) {
  if (damping_.increments().empty()) return {};
  const Damped damped{.impulse = damping_.impulse() + planes_.damping_impulse(grid, Nodes::others) +
                                 planes_.damping_impulse(grid, Nodes::awaited),
                      .work = damping_.work(grid)};
  damping_.clear();
  planes_.set_damping({});
  return damped;
}

Vector3 GridUpdate::share_step(BlockGrid& grid) {
  mirror_contact_.tell_others(grid);
  grid.begin_borrow_from_owners(BlockGrid::Part::both);
  awaiting_ = Awaiting::step;
  meet_images(grid, Nodes::others);
  return impulse(grid, Nodes::others);
}

void GridUpdate::solve_velocity(BlockGrid& grid) {
  complete_sums(grid, BlockGrid::Part::first);
  mirror_contact_.lay_out(grid);
  transfer::solve_velocity(grid, [&](std::size_t block) { return mirror_contact_.concerns_block(block); });
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
  return impulse(grid, Nodes::awaited);
}

}  // namespace whipple::contact

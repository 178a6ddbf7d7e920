// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "src/contact/mirror_contact.hpp"
#include "src/grid/block_grid.hpp"
#include "src/transfer/local_damping.hpp"
#include "src/transfer/mirror_planes.hpp"
#include "src/transfer/momentum.hpp"

namespace whipple::contact {

/// Advances the nodes by one step: sums over ranks, momentum equation, mirror planes and walls with the contact between
/// material and its images (docs/theory/mpm.md, section 3). Communication of shared nodes can overlap with computation
/// in the interior.
class GridUpdate {
 public:
  /// Sends the contributions of the border to the owners of the nodes, before those of the interior are complete.
  /// Optional. Collective.
  void send(grid::BlockGrid& grid, grid::BlockGrid::Part part);

  /// Folds the nodes beyond the mirror planes onto their images where the material is continuous with its image, adds
  /// the contributions of all ranks, and solves m dv/dt = f (equation 3.4) at the nodes of this rank. Replaces NodeSums
  /// by NodeMotion. Contact between bodies may then change the increments of contact slots (grid::BlockGrid); there it
  /// must replace NodeMotion::mass_for_contact by the heat of the nodes. Collective.
  /// @param damping  coefficient of local damping (3.5e); 0: none
  void solve_momentum(grid::BlockGrid& grid, double dt, const transfer::Relaxation& relaxation,
                      double damping = 0.0);
  /// Sends velocities and increments of the nodes to the ranks that use them, copies them to the nodes beyond the
  /// planes and applies contact with the images at the other planes. Ghost nodes (grid::BlockGrid::is_awaited) are
  /// completed by `receive`. Collective.
  /// @returns impulse of mirror planes and walls on the particles by the nodes that are not awaited, N s
  Vector3 share_step(grid::BlockGrid& grid);

  /// Divides momentum by mass in `first`, in place (second pass of MUSL, full mass matrix), and sends the velocities as
  /// `share_step` does. Contact with the images uses the contact fractions of the step or, before these are known,
  /// fractions from the approach velocities. Collective.
  void solve_velocity(grid::BlockGrid& grid);

  /// Receives the values of nodes owned by other ranks, if an exchange is under way. Call at the latest before the
  /// particles of the border use them. Collective.
  /// @returns impulse of mirror planes and walls by these nodes, N s; zero after `solve_velocity`
  Vector3 receive(grid::BlockGrid& grid);

  /// Registers a function that is called, one after the other, with every node at a plane or, on request, in a contact
  /// slot, and the impulse (N s) that planes, walls and contact gave to the particles of this rank there in a step.
  using WatchImpulse = std::function<void(std::uint32_t node, const Vector3& impulse)>;
  void watch_impulses(WatchImpulse watch, bool also_contact) {
    watch_ = std::move(watch);
    planes_.remember_contact(also_contact);
  }

  /// Returns the contact between material and its images. Its surfaces must be found in every step before the nodes are
  /// advanced.
  [[nodiscard]] MirrorContact& mirror_contact() { return mirror_contact_; }
  /// Holds impulse (N s) and work (J) of local damping on this rank.
  struct Damped {
    Vector3 impulse = Vector3::Zero();
    double work = 0.0;
  };
  /// Returns those of the step, once: call after the last `receive`.
  [[nodiscard]] Damped take_damping(const grid::BlockGrid& grid);
  /// Returns the contact dissipation (J) at the mirror planes on this rank since the last call.
  double take_contact_heat() { return std::exchange(contact_heat_, 0.0); }

 private:
  void complete_sums(grid::BlockGrid& grid, grid::BlockGrid::Part part);
  void meet_images(grid::BlockGrid& grid, transfer::Nodes which);
  [[nodiscard]] Vector3 impulse(const grid::BlockGrid& grid, transfer::Nodes which) const;
  void meet_images_again(grid::BlockGrid& grid, transfer::Nodes which);

  transfer::MirrorPlanes planes_;
  WatchImpulse watch_;
  transfer::LocalDamping damping_;
  MirrorContact mirror_contact_;
  double contact_heat_ = 0.0;  // J
  bool sent_ = false;          // `send` was called
  enum class Awaiting : std::uint8_t { nothing, step, velocity } awaiting_ = Awaiting::nothing;
  double dt_ = 0.0;  // of the current step
};

}  // namespace whipple::contact

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>

#include "src/contact/mirror_contact.hpp"
#include "src/grid/block_grid.hpp"
#include "src/transfer/mirror_planes.hpp"
#include "src/transfer/momentum.hpp"

namespace whipple::contact {

/// The step of the nodes: sums of all ranks, momentum equation, mirror planes and walls, with the contact of material and its
/// images there (docs/theory/mpm.md, 3). What other ranks do at shared nodes may be under way while the interior is worked
/// on.
class GridUpdate {
 public:
  /// Sends the owners what the border has brought, before the interior has. May be left out. Collective.
  void send(grid::BlockGrid& grid, grid::BlockGrid::Part part);

  /// Folds the nodes beyond the mirror planes onto their images where material is one with its image, adds up the parts
  /// of all ranks, and solves m dv/dt = f (equation 3.4) at the nodes of this rank: NodeSums before, NodeMotion after.
  /// Then contact between bodies may change the increments of contact slots (grid::BlockGrid), where it must replace
  /// NodeMotion::mass_for_contact by the heat that the nodes give. Collective.
  transfer::NodeEnergies solve_momentum(grid::BlockGrid& grid, double dt,
                                        const transfer::Relaxation& relaxation);
  /// Sends the step of the nodes to the ranks that use them, copies it to the nodes beyond the planes and applies the
  /// contact with the images elsewhere. Ghost nodes (grid::BlockGrid::is_awaited) follow with `receive`. Collective.
  /// @returns N s, impulse of mirror planes and walls on the particles, by the nodes that are not awaited
  Vector3 share_step(grid::BlockGrid& grid);

  /// Divides momentum by mass in `first`, in place (second pass of MUSL, full mass matrix), and sends the velocities as
  /// `share_step` does. Material and image are in contact as the step found them to be; before it by their approach.
  /// Collective.
  void solve_velocity(grid::BlockGrid& grid);

  /// Receives what other ranks sent of their nodes, if anything is under way: at the latest when the particles of the
  /// border need it. Collective.
  /// @returns N s, impulse of mirror planes and walls by these nodes; zero after `solve_velocity`
  Vector3 receive(grid::BlockGrid& grid);

  /// Contact of material with its image: surfaces must be found in every step before the nodes are advanced.
  [[nodiscard]] MirrorContact& mirror_contact() { return mirror_contact_; }
  /// Heat that it made since the last call (J), of this rank.
  double take_contact_heat() { return std::exchange(contact_heat_, 0.0); }

 private:
  void complete_sums(grid::BlockGrid& grid, grid::BlockGrid::Part part);
  void meet_images(grid::BlockGrid& grid, transfer::Nodes which);
  void meet_images_again(grid::BlockGrid& grid, transfer::Nodes which);

  transfer::MirrorPlanes planes_;
  MirrorContact mirror_contact_;
  double contact_heat_ = 0.0;  // J
  bool sent_ = false;          // by `send`
  enum class Awaiting : std::uint8_t { nothing, step, velocity } awaiting_ = Awaiting::nothing;
  double dt_ = 0.0;  // of the step under way
};

}  // namespace whipple::contact

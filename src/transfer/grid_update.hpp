// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "src/grid/block_grid.hpp"
#include "src/transfer/mirror_contact.hpp"

namespace whipple::transfer {

/// Rate at which a step relaxes the affine fields of the particles towards the grid velocity
/// (docs/theory/mpm.md, 4).
struct Relaxation {
  /// beta = 1 - exp(-kappa c dt / dx) with the node's sound speed c; the same answer for every time step.
  double kappa = 0.2;
  /// beta itself, per step, instead: 0 is FLIP, 1 is APIC. Negative: use kappa.
  double fixed = -1.0;
};

/// Kinetic energy of the nodes of this rank, J.
struct NodeEnergies {
  double before = 0.0;  ///< of the momentum equation
  double after = 0.0;   ///< of it, before contact
  NodeEnergies& operator+=(const NodeEnergies& other) {
    before += other.before;
    after += other.after;
    return *this;
  }
};

/// Mirror planes, walls and the momentum equation on the nodes.
class GridUpdate {
 public:
  /// Sends the owners what the border has brought, before the interior has. May be left out. Collective.
  void send(grid::BlockGrid& grid, grid::BlockGrid::Part part);

  /// Folds the nodes beyond the mirror planes onto their images where material is one with its image, adds up the parts
  /// of all ranks, and solves m dv/dt = f (equation 3.4) at the nodes of this rank: NodeSums before, NodeMotion after.
  /// Then contact between bodies may change the increments of contact slots (grid::BlockGrid), where it must replace
  /// NodeMotion::mass_for_contact by the heat that the nodes give. Collective.
  NodeEnergies solve_momentum(grid::BlockGrid& grid, double dt, const Relaxation& relaxation);
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
  /// Nodes that `is_awaited` concerns, the others, or both.
  enum class Nodes { awaited, others, all };
  [[nodiscard]] static bool among(const grid::BlockGrid& grid, std::uint32_t node, Nodes nodes) {
    return nodes == Nodes::all || grid.is_awaited(node) == (nodes == Nodes::awaited);
  }
  void fold_planes(grid::BlockGrid& grid, Nodes which, bool with_forces);
  static void copy_back(grid::BlockGrid& grid, Nodes which);
  void complete_sums(grid::BlockGrid& grid, grid::BlockGrid::Part part);
  void meet_images(grid::BlockGrid& grid, Nodes which);
  void meet_images_again(grid::BlockGrid& grid, Nodes which);
  void remember_nodes_at_planes(const grid::BlockGrid& grid);
  void remember_content(const grid::BlockGrid& grid, Nodes which);
  [[nodiscard]] Vector3 wall_impulse(const grid::BlockGrid& grid, Nodes which) const;

  std::vector<std::uint32_t> at_planes_;  // nodes that the planes may change, ascending
  std::vector<std::uint8_t>
      may_be_unchanged_;  // of each: it is only an image, which may have received nothing
  std::size_t at_planes_of_ = static_cast<std::size_t>(-1);  // layout that they belong to
  std::vector<grid::Node> before_;  // their content before the fold: what the real particles brought
  MirrorContact mirror_contact_;
  double contact_heat_ = 0.0;  // J
  bool sent_ = false;          // by `send`
  enum class Awaiting { nothing, step, velocity } awaiting_ = Awaiting::nothing;
  double dt_ = 0.0;  // of the step under way
};

}  // namespace whipple::transfer

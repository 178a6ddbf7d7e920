// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
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

/// Balance of a grid update: the contribution of this rank.
struct GridBalance {
  double kinetic_energy_before = 0.0;  ///< J, of the nodes
  double kinetic_energy_after = 0.0;   ///< J, before contact
  Vector3 wall_impulse =
      Vector3::Zero();  ///< N s, from mirror planes and walls on the particles in this step
};

/// Mirror planes, walls and the momentum equation on the nodes.
class GridUpdate {
 public:
  /// Folds the nodes beyond the mirror planes onto their images where material is one with its image, adds up
  /// the parts of all ranks, solves m dv/dt = f (equation 3.4), copies the result back to the nodes beyond,
  /// and applies the contact with the images elsewhere. Collective. Nodes hold NodeSums before it, NodeMotion
  /// after it.
  /// @param at_contact  called when the nodes of this rank have their step, before others learn of it: may
  ///                    change the velocity increments of contact slots (grid::BlockGrid), where it must
  ///                    replace NodeMotion::mass_for_contact by the heat that nodes give
  GridBalance advance(grid::BlockGrid& grid, double dt, const Relaxation& relaxation,
                      const std::function<void()>& at_contact = {});

  /// Velocity of mass and momentum in `first`, in place (second pass of MUSL, full mass matrix). Material and
  /// image are in contact as the `advance` of the same step found them to be; before it by their approach.
  /// Collective.
  void velocity_from_momentum(grid::BlockGrid& grid);

  /// Contact of material with its image: surfaces must be found in every step before the nodes are advanced.
  [[nodiscard]] MirrorContact& mirror_contact() { return mirror_contact_; }
  /// Heat that it made since the last call (J), of this rank.
  double take_contact_heat() { return std::exchange(contact_heat_, 0.0); }

  /// @name The same in parts, so that work on the interior hides the exchange
  /// @{
  /// Sends the owners what the border has brought, before the interior has. May be left out.
  void send(grid::BlockGrid& grid, grid::BlockGrid::Part part);
  /// As `advance` and `velocity_from_momentum`, but ghost nodes (grid::BlockGrid::is_awaited) may still
  /// be under way.
  GridBalance begin_advance(grid::BlockGrid& grid, double dt, const Relaxation& relaxation,
                            const std::function<void()>& at_contact = {});
  void begin_velocity_from_momentum(grid::BlockGrid& grid);
  /// Waits for it, before the gather of the border.
  /// @returns N s, what the planes did there; nothing after `begin_velocity_from_momentum`
  Vector3 finish(grid::BlockGrid& grid);
  /// @}

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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "src/solver/loads.hpp"
#include "src/solver/stages/activity.hpp"
#include "src/solver/stages/drive.hpp"
#include "src/solver/state.hpp"
#include "src/transfer/conduction.hpp"
#include "src/transfer/full_mass_matrix.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/grid_update.hpp"
#include "src/transfer/shock_conduction.hpp"

namespace whipple::solver {

/// Transfers between particles, nodes of elements and the grid, and the momentum equation on the grid
/// (docs/theory/mpm.md, 3 to 5; docs/theory/dissipation.md). What the nodes of a rank's border receive from other ranks
/// is under way while the interior is worked on: `send_*` starts it, `receive` waits for it.
class Transfers {
 public:
  Transfers(State& state, const Loads& loads, const Activity& activity);

  [[nodiscard]] transfer::GridUpdate& grid_update() { return grid_update_; }

  /// Evaluates the accelerations of particles by loads in this step, and accumulates their impulse.
  void evaluate_loads();
  /// Conducts heat inside shocks.
  void conduct_in_shocks();
  /// Conducts heat between particles.
  void conduct_heat(const transfer::TouchAtNode& touch);

  /// Adds mass, momentum and forces of particles and nodes of elements to the grid.
  /// @param send  called once the border has all that this rank gives to it
  void to_grid(const std::function<void()>& send);
  /// Adds mass and momentum of particles to the grid and divides them; the velocities of nodes are then sent to the
  /// ranks that use them.
  /// @param send  as of `to_grid`
  void momentum_to_grid(const std::function<void()>& send);
  /// Sends the sums of the border to the owners of its nodes: mass and momentum.
  void send_momentum() { grid_update_.send(state_.grid, grid::BlockGrid::Part::first); }
  /// Sends forces, too.
  void send_sums() { grid_update_.send(state_.grid, grid::BlockGrid::Part::both); }

  /// Advances the velocities of the nodes; their results are then sent to the ranks that use them.
  /// @param contact  called when the nodes of this rank have their velocity without contact
  void advance_grid(const std::function<void()>& contact);
  /// Inverts the full mass matrix where the case asks for it (FMPM).
  void apply_full_mass_matrix();
  /// Receives the results of nodes that other ranks own, at the latest when the particles of the border need them.
  void receive();

  /// Updates velocity, affine field, energy and position of particles and nodes of elements by the grid.
  /// @param take     gets the velocity gradients of particles, for the constitutive update
  /// @param receive  called before the border is gathered
  void to_particles(const transfer::TakeGradients& take, const std::function<void()>& receive);
  /// Updates velocity and position of particles by the grid.
  /// @param take     gets the velocity gradients, if not empty
  void velocity_to_particles(const transfer::TakeGradients& take, const std::function<void()>& receive);
  /// Gathers the velocity gradients only.
  void gradient_to_particles(const transfer::TakeGradients& take, const std::function<void()>& receive);

 private:
  void fly();

  State& state_;
  const Loads& loads_;
  const Activity& activity_;
  Drive drive_;
  transfer::GridUpdate grid_update_;
  transfer::FullMassMatrix full_mass_matrix_;
  transfer::Losses losses_;
  std::vector<transfer::ShockConductivity> shock_conductivity_;  // of each body
  std::vector<Vector3> acceleration_;  // of particles by loads in this step; empty without
};

}  // namespace whipple::solver

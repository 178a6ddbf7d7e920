// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/contact/grid_update.hpp"
#include "src/solver/loads.hpp"
#include "src/solver/stages/activity.hpp"
#include "src/solver/stages/drive.hpp"
#include "src/solver/stages/full_mass_matrix.hpp"
#include "src/solver/state.hpp"
#include "src/transfer/averages.hpp"
#include "src/transfer/conduction.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/shared_cells.hpp"
#include "src/transfer/shock_conduction.hpp"
#include "src/transfer/sweep.hpp"

namespace whipple::solver {

/// Performs the transfers between particles, nodes of elements and the grid, and the momentum equation on the grid
/// (docs/theory/mpm.md, sections 3 to 5; docs/theory/dissipation.md). Communication of the nodes of a rank's border
/// overlaps with computation in the interior: `send_*`, `share_step` and `solve_velocity` start it, `receive` completes
/// it.
class Transfers {
 public:
  Transfers(State& state, const Loads& loads, const Activity& activity);

  [[nodiscard]] contact::GridUpdate& grid_update() { return grid_update_; }

  /// Evaluates the accelerations of particles by loads in this step and accumulates their impulse.
  void evaluate_loads();
  /// Conducts heat inside shocks.
  void conduct_in_shocks();
  /// Conducts heat between particles.
  void conduct_heat(const transfer::TouchAtNode& touch);

  /// Clears the nodes, before `to_grid`.
  void clear_grid() { state_.grid.clear(); }
  /// Finds the cells whose particles several ranks have, of bodies with `volumetric = "cell"`. Call after binning.
  /// Collective.
  void find_shared_cells();
  /// Averages the stress of these bodies, before `to_grid`. Collective.
  void average_stress();
  /// Adds mass, momentum and forces of the particles and nodes of elements of a region to the grid.
  void to_grid(transfer::Region region);
  /// Accumulates the force of the hoop stress of rings towards the axis, which changes their momentum.
  void account_for_hoops();
  /// Sends the sums of the border to the owners of its nodes.
  void send_sums() { grid_update_.send(state_.grid, grid::BlockGrid::Part::both); }

  /// Clears mass and momentum of the nodes, before `momentum_to_grid`.
  void clear_momentum();
  /// Adds mass and momentum of the particles of a region to the grid.
  void momentum_to_grid(transfer::Region region);
  /// Sends the mass and momentum of the border to the owners of its nodes.
  void send_momentum() { grid_update_.send(state_.grid, grid::BlockGrid::Part::first); }
  /// Divides the momentum of the nodes by their mass and sends the velocities to the ranks that use them.
  void solve_velocity() { grid_update_.solve_velocity(state_.grid); }

  /// Advances the velocities of the nodes of this rank, without contact between bodies.
  void solve_momentum();
  /// Sends the motion of the nodes to the ranks that use them.
  void share_step();
  /// Applies the inverse of the full mass matrix where the case requests it (FMPM).
  void apply_full_mass_matrix();
  /// Receives the results of nodes owned by other ranks. Call at the latest before the particles of the border use
  /// them.
  void receive();

  /// Updates velocity, affine field, energy and position of the particles of a stretch from the grid; stores their
  /// velocity gradients in the stretch.
  void to_particles(const transfer::Stretch& stretch);
  /// Updates velocity and position of the particles of a stretch from the grid; stores the requested gradients in the
  /// stretch.
  void velocity_to_particles(const transfer::Stretch& stretch, transfer::Gradients gradients);
  /// Gathers the velocity gradients of the particles of a stretch.
  void gradient_to_particles(const transfer::Stretch& stretch);
  /// Returns all particles on the grid in stretches; those that the sums of `sum_volume_rates` await are of the border.
  [[nodiscard]] transfer::Sweep sweep() { return transfer::Sweep(state_.grid, shared_cells_); }
  /// Returns whether volume rates are averaged over particles of several ranks.
  [[nodiscard]] bool averages_over_ranks() const { return averaged_.any() && state_.grid.is_shared(); }
  /// Sums the volume rates of the border in the cells that ranks share, after its velocity gradients, which the sweep
  /// must keep. Collective.
  void sum_volume_rates(transfer::Sweep& sweep);
  /// Averages the volume rate of a stretch in bodies with `volumetric = "cell"`, after its velocity gradients.
  void average_volume_rate(const transfer::Stretch& stretch);
  /// Does the same after `to_particles`, with its work.
  void average_volume_rate_and_work(const transfer::Stretch& stretch);
  /// Accumulates work and losses of a sweep, and stores the maximum change of a velocity.
  void account_for(const transfer::TransferBalance& balance);
  /// Updates velocity, affine field and position of the nodes of elements from the grid.
  void to_nodes();
  /// Moves the particles in free flight.
  void fly();

 private:
  State& state_;
  const Loads& loads_;
  const Activity& activity_;
  Drive drive_;
  contact::GridUpdate grid_update_;
  FullMassMatrix full_mass_matrix_;
  transfer::Losses losses_;
  std::vector<transfer::ShockConductivity> shock_conductivity_;  // of each body
  std::vector<Vector3> acceleration_;  // of particles by loads in this step; empty if there are none
  transfer::AveragedBodies averaged_;
  transfer::SharedCells shared_cells_;
  std::vector<double> mean_stress_;  // of particles in this step; empty if no body is averaged
};

}  // namespace whipple::solver

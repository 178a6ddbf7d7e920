// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/activity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

#include "src/core/base/random_bits.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solver/carriers/explosives.hpp"

namespace whipple::solver {
namespace {

constexpr std::int64_t look_for_rest_every = 20;  // steps
/// Fraction of the former number of particles at rest below which the blocks are distributed over the ranks again.
constexpr double rest_of_old_shares = 0.8;

/// Returns the first time (s), not before the given one, at which a material changes although it is at rest.
double next_event(const Material& material, const cases::HeatControl& heat, double time) {
  return heat.conduction && material.conductivity > 0.0 ? time : std::numeric_limits<double>::infinity();
}

/// Returns a number in [0, 1) that depends on the arguments only: equal on all ranks and after a restart.
double random_number(std::uint64_t seed, std::uint64_t step, std::uint64_t axis) {
  return static_cast<double>(random_bits((seed << 40U) + 4 * step + axis, 0) >> 11U) * 0x1p-53;
}

}  // namespace

/// Shifts the grid along axes without walls: walls are located on nodes.
void Activity::shift_grid() {
  if (!state_.setup.transfer.random_shift) return;
  Vector3 cells = Vector3::Zero();
  for (int a = 0; a < 3; ++a) {
    const auto face = static_cast<std::size_t>(2 * a);
    if (state_.setup.geometry.boundary[face] != grid::Boundary::outflow ||
        state_.setup.geometry.boundary[face + 1] != grid::Boundary::outflow) {
      continue;
    }
    cells[a] = random_number(static_cast<std::uint64_t>(state_.setup.transfer.random_seed),
                             static_cast<std::uint64_t>(state_.run.step), static_cast<std::uint64_t>(a)) -
               0.5;
  }
  state_.grid.shift(cells);
}

void Activity::find() {
  flying_.clear();
  const double end = state_.run.time + state_.run.time_step;
  // Loads act on particles through the grid.
  if (state_.setup.transfer.free_flight && loads_.next_event(state_.run.time) >= end) find_free_flight();
  let_material_rest();
}

/// Finds failed particles without stress that have no other particle within two cells: for them the transfers are the
/// identity, so that they move freely.
void Activity::find_free_flight() {
  const auto without_stress = [&](std::size_t p) {
    return state_.particles.failed[p] != 0 && state_.particles.pressure[p] == 0.0 &&
           state_.particles.artificial_viscosity[p] == 0.0;
  };
  const std::vector<std::uint32_t> loose = parallel::where(state_.particles.size(), without_stress);
  if (loose.empty()) return;
  state_.grid.count_cells(state_.particles.position, state_.transition.position);
  std::ranges::copy_if(loose, std::back_inserter(flying_), [&](std::uint32_t p) {
    return state_.grid.is_alone(p, state_.particles.position[p]);
  });
  state_.grid.release(flying_);
}

bool Activity::is_restless(std::size_t p) const {
  const double tolerance = state_.setup.transfer.rest_tolerance,
               sound_speed = state_.particles.sound_speed[p];
  const double speed = tolerance * sound_speed;
  // The negations also catch NaN.
  if (!(state_.particles.velocity[p].cwiseAbs().maxCoeff() <= speed)) return true;
  if (state_.carries_affine_fields() &&
      !(state_.cell_size_at(p) * state_.particles.affine_velocity[p].cwiseAbs().maxCoeff() <= speed)) {
    return true;
  }
  const SymmetricTensor& s = state_.particles.deviatoric_stress[p];
  const double stress = std::abs(state_.particles.pressure[p]) +
                        std::abs(state_.particles.artificial_viscosity[p]) + std::sqrt(s.squared_norm());
  return !(stress * state_.particles.volume[p] <= speed * sound_speed * state_.particles.mass[p]);
}

double Activity::next_event() const {
  double next = loads_.next_start(state_.run.time);
  for (const auto& material : state_.setup.materials) {
    next = std::min(next, solver::next_event(*material, state_.setup.heat, state_.run.time));
  }
  return next;
}

bool Activity::material_may_rest() const {
  return state_.setup.transfer.rest_tolerance > 0.0 && next_event() >= state_.run.time + state_.run.time_step;
}

/// Returns whether explosive burns, or begins to burn before a time (s). Collective.
bool Activity::explosives_are_lit(double before) const {
  if (!state_.setup.has_burn()) return false;
  const Explosives explosives(state_);
  const double lit = parallel::maximum(
      state_.particles.size(), 0.0, [&](std::size_t p) { return explosives.is_lit(p, before) ? 1.0 : 0.0; });
  return parallel::maximum(state_.communicator, lit) > 0.0;
}

bool Activity::has_much_woken() const {
  return state_.is_parallel() && static_cast<double>(state_.run.particles_at_rest) <
                                     rest_of_old_shares * static_cast<double>(most_at_rest_);
}

/// Returns how often particles contribute to nodes in a step: each time, motion propagates to blocks that share nodes
/// with moving ones (docs/theory/mpm.md, section 8).
int Activity::layers_ahead_of_motion() const {
  const int layers = cases::transfers_per_step(state_.setup.time.scheme);
  return state_.setup.transfer.particle_update == cases::ParticleUpdate::fmpm
             ? layers + static_cast<int>(state_.setup.transfer.fmpm_order) - 1
             : layers;
}

/// Deactivates blocks without motion and stress until motion may reach them. The layers around moving blocks are active
/// and quiescent: the missing contributions at their outer nodes are below the tolerance. The active blocks conserve
/// mass, momentum and energy among themselves.
void Activity::let_material_rest() {
  if (!material_may_rest()) {
    state_.grid.wake();  // a load may have begun to act
    state_.run.particles_at_rest = 0;
    return;
  }
  // Disturbed material is rarely at rest again, so that this is checked rarely if nothing is at rest.
  if (state_.run.particles_at_rest == 0 && state_.run.step % look_for_rest_every != 0) return;
  const Explosives explosives(state_);
  const double end = state_.run.time + state_.run.time_step;
  if (explosives_are_lit(end))
    state_.grid.wake();  // detonation begins in material at rest, too: all blocks are examined
  const std::size_t at_rest = state_.grid.let_rest(layers_ahead_of_motion(), [&](std::size_t slot) {
    return std::ranges::any_of(state_.grid.particles_in(slot),
                               [&](std::uint32_t p) { return is_restless(p) || explosives.is_lit(p, end); });
  });
  std::array<double, 1> of_all_ranks = {static_cast<double>(at_rest)};
  parallel::sum(state_.communicator, of_all_ranks);
  state_.run.particles_at_rest = static_cast<std::int64_t>(of_all_ranks[0]);
  most_at_rest_ = std::max(most_at_rest_, state_.run.particles_at_rest);
}

}  // namespace whipple::solver

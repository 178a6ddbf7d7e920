// SPDX-License-Identifier: BSD-3-Clause
// Particles and grid apart: free flight, material at rest, and random shifts of the grid (docs/theory/mpm.md,
// section 8).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::solver {
namespace {

constexpr std::int64_t look_for_rest_every = 20;  // steps

/// A number in [0, 1) that depends on its arguments only: the same on all ranks and after a restart
/// (splitmix64: Steele, Lea & Flood, OOPSLA 2014).
double random_number(std::uint64_t seed, std::uint64_t step, std::uint64_t axis) {
  std::uint64_t z = (seed << 40U) + 4 * step + axis;
  for (int round = 0; round < 2; ++round) {
    z += 0x9e3779b97f4a7c15ULL;
    z = (z ^ z >> 30U) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ z >> 27U) * 0x94d049bb133111ebULL;
    z ^= z >> 31U;
  }
  return static_cast<double>(z >> 11U) * 0x1p-53;
}

}  // namespace

/// Walls lie on nodes, so the grid keeps its place along their normals.
void Simulation::shift_grid() {
  Vector3 cells = Vector3::Zero();
  for (int a = 0; a < 3; ++a) {
    const auto face = static_cast<std::size_t>(2 * a);
    if (setup_.geometry.boundary[face] != grid::Boundary::outflow ||
        setup_.geometry.boundary[face + 1] != grid::Boundary::outflow) {
      continue;
    }
    cells[a] = random_number(static_cast<std::uint64_t>(setup_.transfer.random_seed),
                             static_cast<std::uint64_t>(state_.step), static_cast<std::uint64_t>(a)) -
               0.5;
  }
  grid_.shift(cells);
}

/// A failed particle without stress whose surroundings of two cells hold no other one moves on by itself: the
/// transfers would give back what they were given.
void Simulation::find_free_flight() {
  flying_.clear();
  const auto without_stress = [&](std::size_t p) {
    return particles_.failed[p] != 0 && particles_.pressure[p] == 0.0 &&
           particles_.artificial_viscosity[p] == 0.0;
  };
  const std::vector<std::uint32_t> loose = parallel::where(particles_.size(), without_stress);
  if (loose.empty()) return;
  grid_.count_cells(particles_.position, transition_.position);
  std::ranges::copy_if(loose, std::back_inserter(flying_),
                       [&](std::uint32_t p) { return grid_.is_alone(p, particles_.position[p]); });
  grid_.release(flying_);
}

/// Returns whether a particle moves or bears a stress.
bool Simulation::is_restless(std::size_t p) const {
  const double tolerance = setup_.transfer.rest_tolerance, sound_speed = particles_.sound_speed[p];
  const double speed = tolerance * sound_speed;
  // The negations also catch NaN.
  if (!(particles_.velocity[p].cwiseAbs().maxCoeff() <= speed)) return true;
  if (!particles_.affine_velocity.empty() &&
      !(setup_.domain.cell_size * particles_.affine_velocity[p].cwiseAbs().maxCoeff() <= speed)) {
    return true;
  }
  const SymmetricTensor& s = particles_.deviatoric_stress[p];
  const double stress = std::abs(particles_.pressure[p]) + std::abs(particles_.artificial_viscosity[p]) +
                        std::sqrt(s.squared_norm());
  return !(stress * particles_.volume[p] <= speed * sound_speed * particles_.mass[p]);
}

bool Simulation::matter_may_rest() const {
  return setup_.transfer.rest_tolerance > 0.0 && accelerations_.empty() && !setup_.heat.conduction;
}

/// How often particles bring something to the nodes in a step: each time, motion gets to blocks that share
/// nodes with those where it was (docs/theory/mpm.md, section 8).
int Simulation::layers_ahead_of_motion() const {
  const int layers = cases::transfers_per_step(setup_.time.scheme);
  return setup_.transfer.particle_update == cases::ParticleUpdate::fmpm
             ? layers + static_cast<int>(setup_.transfer.fmpm_order) - 1
             : layers;
}

/// Blocks without motion and stress keep their state until motion may reach them. The layers between take
/// part and are quiet: what is missing at their outer nodes is below the tolerance. What takes part keeps
/// mass, momentum and energy among itself.
void Simulation::let_matter_rest() {
  if (!matter_may_rest()) {
    grid_.wake();  // forces may have been set
    return;
  }
  // What has been stirred hardly comes to rest again: where nothing rests, that is seldom looked for.
  if (state_.particles_at_rest == 0 && state_.step % look_for_rest_every != 0) return;
  const std::size_t at_rest = grid_.let_rest(layers_ahead_of_motion(), [&](std::size_t slot) {
    return std::ranges::any_of(grid_.particles_in(slot), [&](std::uint32_t p) { return is_restless(p); });
  });
  std::array<double, 1> of_all_ranks = {static_cast<double>(at_rest)};
  parallel::sum(communicator_, of_all_ranks);
  state_.particles_at_rest = static_cast<std::int64_t>(of_all_ranks[0]);
  most_at_rest_ = std::max(most_at_rest_, state_.particles_at_rest);
}

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
// Particles and grid apart: free flight, and random shifts of the grid (docs/theory/mpm.md, section 8).
#include <cmath>
#include <cstdint>

#include "src/solver/simulation.hpp"

namespace whipple::solver {
namespace {

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
  grid_.count_cells(particles_.position, transition_.position);
  for (std::uint32_t p = 0; p < particles_.size(); ++p) {
    if (without_stress(p) && grid_.is_alone(p, particles_.position[p])) flying_.push_back(p);
  }
  grid_.release(flying_);
}

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "src/particles/particles.hpp"

/// What is conserved, and where it went.
namespace whipple::solver {

/// Sums over a set of particles (SI).
struct Totals {
  double mass = 0.0;
  Vector3 momentum = Vector3::Zero();
  double momentum_scale = 0.0;         ///< sum m |v|, to judge momentum errors by
  double kinetic_energy = 0.0;         ///< of the particles' own velocities
  double affine_kinetic_energy = 0.0;  ///< of their affine fields: m dx^2 |C|^2 / 8
  double internal_energy = 0.0;

  [[nodiscard]] double energy() const { return kinetic_energy + affine_kinetic_energy + internal_energy; }
  Totals& operator+=(const Totals& other);
};

/// Of one particle.
Totals totals_of(const Particles& particles, std::size_t p, double cell_size);
/// Of all particles; bitwise independent of the number of threads.
Totals totals_of(const Particles& particles, double cell_size);

/// Books everything that enters and leaves, so that at every time
/// energy = initial - outflow, momentum = initial - outflow + impulse of the walls.
struct Ledger {
  Totals initial;
  Totals outflow;
  Vector3 wall_impulse = Vector3::Zero();  ///< N s, by mirror planes and walls
  double work = 0.0;                       ///< J, stress on strain, into internal energy
  double transfer_heat = 0.0;              ///< J, kinetic energy lost in transfers, into internal energy
  double clamped_to_cold_curve =
      0.0;  ///< evaluations below the cold curve (temperature clamped, energy kept)
  double limited_volume_changes = 0.0;  ///< steps of particles whose volume change was limited

  /// Relative error of the total energy.
  [[nodiscard]] double energy_error(const Totals& now) const;
  /// Error of the momentum relative to the initial sum of m |v|.
  [[nodiscard]] double momentum_error(const Totals& now) const;
};

/// Masses by phase and other figures for the history.
struct PhaseMasses {
  std::array<double, 4> mass{};  ///< kg: solid, melting, liquid, vapour
  double failed = 0.0;           ///< kg
  PhaseMasses& operator+=(const PhaseMasses& other);
};
/// One entry per body.
std::vector<PhaseMasses> phase_masses(const Particles& particles, std::size_t bodies);

}  // namespace whipple::solver

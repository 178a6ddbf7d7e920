// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "src/particles/particles.hpp"
#include "src/transfer/loss_formulas.hpp"

namespace whipple::transfer {

/// Destination of the kinetic energy that the transfers of a step remove from a particle.
enum class LossesBecome : std::uint8_t {
  heat,               ///< at once
  unresolved_energy,  ///< in part, which particles carry with an allowance and a closing rate
};

/// Division of the kinetic energy that the transfers of a step remove from a particle (docs/theory/dissipation.md, 2).
struct Losses {
  LossesBecome become = LossesBecome::heat;
  double heat_share = 0.0;  ///< f: of the work of the artificial viscosity that heats
  double allowance_length =
      0.0;  ///< m, tau dx: distance that sound travels until an allowance has decayed; 0: at once
  double collision_rate =
      0.0;  ///< r: fraction of the unresolved energy per fraction of the volume that closes
  std::span<const double> initial_density;  ///< kg/m^3, of each body
};

using formulas::DividedLosses;

/// Divides the losses of a particle (formulas::divide_losses).
/// @param contact       J/kg, contact dissipation of bodies and walls
/// @param viscous_work  J/kg, of the artificial viscosity in the step
/// @param divergence    1/s, tr L of the step
inline DividedLosses divide_losses(const Losses& losses, const Particles& particles, std::size_t p,
                                   double loss, double contact, double viscous_work, double divergence,
                                   double dt) {
  return formulas::divide_losses(
      {.heat_share = losses.heat_share,
       .allowance_length = losses.allowance_length,
       .collision_rate = losses.collision_rate,
       .initial_density = losses.initial_density[particles.body[p]]},
      {.mass = particles.mass[p],
       .volume = particles.volume[p],
       .void_volume = particles.void_volume[p],
       .pressure = particles.pressure[p],
       .sound_speed = particles.sound_speed[p],
       .artificial_viscosity = particles.artificial_viscosity[p],
       .heating_viscosity = particles.heating_viscosity[p],
       .unresolved_energy = particles.unresolved_energy[p],
       .heat_allowance = particles.heat_allowance[p],
       .failed = particles.failed[p] != 0},
      {.loss = loss, .contact = contact, .viscous_work = viscous_work, .divergence = divergence, .dt = dt});
}

}  // namespace whipple::transfer

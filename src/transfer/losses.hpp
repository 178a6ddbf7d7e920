// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/particles/particles.hpp"

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
      0.0;  ///< m, tau dx: the way of sound in which an allowance is forgotten; 0: at once
  double collision_rate =
      0.0;  ///< r: fraction of the unresolved energy per fraction of the volume that closes
  std::span<const double> initial_density;  ///< kg/m^3, of each body
};

/// Destination of the losses of a step, J/kg.
struct Booking {
  double heat = 0.0;        ///< of the transfers: internal energy
  double kept = 0.0;        ///< of the transfers and the viscosity: unresolved energy
  double cooling = 0.0;     ///< of the viscosity: what of its work is not internal but unresolved energy
  double returned = 0.0;    ///< unresolved energy that became internal
  double of_contact = 0.0;  ///< of contact: internal energy
  double allowance = 0.0;   ///< of the particle from now on
};

/// Material with gaps, as far as a particle knows: failed, beside a void, in tension, or thinner than at the
/// start. Material in its initial state has none, and what round-off makes of its pressure and volume does not matter.
inline bool is_loose(const Particles& particles, std::size_t p, double initial_density) {
  constexpr double round_off = 1e-9;  // of rho c^2 and of the density
  const double mass = particles.mass[p], volume = particles.volume[p], c = particles.sound_speed[p];
  return particles.failed[p] != 0 || particles.void_volume[p] > 0.0 ||
         particles.pressure[p] * volume < -round_off * mass * c * c ||
         mass < (1.0 - round_off) * initial_density * volume;
}

/// Divides the loss of the transfers (J/kg, >= 0 but for round-off) and the work of the artificial viscosity
/// between internal and unresolved energy (eq. 3 to 5). In material without gaps the loss is heat as far as the
/// viscosity that heats does work, which measures what of the motion is a shock: a fraction of the work is an allowance,
/// which is used up or forgotten, since the loss of a steady shock comes in steps in which its viscosity may rest.
/// Where gaps close, material collides: all of the loss is heat, and so is the fraction of what had been kept before that the volume loses.
/// Contact heats, but for fragmented material that expands, whose fragments hit those of another body as they hit
/// one another.
/// @param contact       J/kg, what contact of bodies and walls took
/// @param viscous_work  J/kg, of the artificial viscosity in the step
/// @param divergence    1/s, tr L of the step
inline Booking book_losses(const Losses& losses, const Particles& particles, std::size_t p, double loss,
                           double contact, double viscous_work, double divergence, double dt) {
  const bool loose = is_loose(particles, p, losses.initial_density[particles.body[p]]);
  if (loose && divergence < 0.0) {
    const double share = -std::expm1(losses.collision_rate * divergence * dt);
    return {.heat = loss, .returned = share * particles.unresolved_energy[p], .of_contact = contact};
  }
  const double viscosity = particles.artificial_viscosity[p];
  const double heating = viscosity > 0.0 ? particles.heating_viscosity[p] / viscosity : 1.0;
  const double work = std::fmax(viscous_work, 0.0), heating_work = heating * work,
               cooling = work - heating_work;
  double allowance = losses.heat_share * heating_work;
  if (const double before = particles.heat_allowance[p]; before > 0.0 && losses.allowance_length > 0.0) {
    allowance += before * std::exp(-particles.sound_speed[p] * dt / losses.allowance_length);
  }
  const double heat = std::fmin(loss, allowance);
  const double of_contact = loose ? 0.0 : contact;
  return {.heat = heat,
          .kept = loss - heat + cooling + (contact - of_contact),
          .cooling = cooling,
          .of_contact = of_contact,
          .allowance = allowance - std::fmax(heat, 0.0)};
}

}  // namespace whipple::transfer

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "src/core/base/dialect.hpp"

/// Destination of the kinetic energy that a transfer removes from a point (docs/theory/dissipation.md, 2).
namespace whipple::transfer::formulas {

/// Division of the losses of a body's points.
struct LossRates {
  double heat_share;  ///< f: of the work of the artificial viscosity that heats
  double
      allowance_length;  ///< m, tau dx: distance that sound travels until an allowance has decayed; 0: at once
  double collision_rate;   ///< r: fraction of the unresolved energy per fraction of the volume that closes
  double initial_density;  ///< kg/m^3
};

/// State of a point before the step.
struct LossyPoint {
  double mass, volume, void_volume;                ///< kg, m^3
  double pressure, sound_speed;                    ///< Pa, m/s
  double artificial_viscosity, heating_viscosity;  ///< Pa
  double unresolved_energy, heat_allowance;        ///< J/kg
  bool failed;
};

/// Changes of a point in the step.
struct LossyStep {
  double loss;          ///< J/kg, of the transfers, >= 0 but for round-off
  double contact;       ///< J/kg, contact dissipation of bodies and walls
  double viscous_work;  ///< J/kg, of the artificial viscosity
  double divergence;    ///< 1/s, tr L
  double dt;            ///< s
};

/// Destination of the losses of a step, J/kg.
struct DividedLosses {
  double heat = 0.0;     ///< of the transfers: internal energy
  double kept = 0.0;     ///< of the transfers and the viscosity: unresolved energy
  double cooling = 0.0;  ///< of the viscosity: part of its work that is unresolved instead of internal energy
  double returned = 0.0;    ///< unresolved energy that became internal
  double of_contact = 0.0;  ///< of contact: internal energy
  double allowance = 0.0;   ///< of the particle from now on
};

/// Returns whether the state of a particle indicates gaps: failed, beside a void, in tension, or less dense than at
/// the start. Material in its initial state has none; round-off of its pressure and volume does not matter.
WHIPPLE_POINT inline bool is_loose(const LossyPoint& point, double initial_density) {
  constexpr double round_off = 1e-9;  // of rho c^2 and of the density
  return point.failed || point.void_volume > 0.0 ||
         point.pressure * point.volume < -round_off * point.mass * point.sound_speed * point.sound_speed ||
         point.mass < (1.0 - round_off) * initial_density * point.volume;
}

/// Divides the loss of the transfers (J/kg, >= 0 but for round-off) and the work of the artificial viscosity
/// between internal and unresolved energy (eq. 3 to 5). In material without gaps the loss is heat as far as the
/// viscosity that heats does work, which measures how much of the motion is a shock: a fraction of the work is an allowance,
/// which is used up or decays, since the loss of a steady shock comes in steps in which its viscosity may vanish.
/// Where gaps close, material collides: all of the loss is heat, and so is the fraction of the unresolved energy by which the volume decreases.
/// Contact heats, but for fragmented material that expands, whose fragments hit those of another body as they hit
/// one another.
WHIPPLE_POINT inline DividedLosses divide_losses(const LossRates& rates, const LossyPoint& point,
                                                 const LossyStep& step) {
  const bool loose = is_loose(point, rates.initial_density);
  if (loose && step.divergence < 0.0) {
    const double share = -std::expm1(rates.collision_rate * step.divergence * step.dt);
    return {.heat = step.loss, .returned = share * point.unresolved_energy, .of_contact = step.contact};
  }
  const double heating =
      point.artificial_viscosity > 0.0 ? point.heating_viscosity / point.artificial_viscosity : 1.0;
  const double work = std::fmax(step.viscous_work, 0.0), heating_work = heating * work,
               cooling = work - heating_work;
  double allowance = rates.heat_share * heating_work;
  if (const double before = point.heat_allowance; before > 0.0 && rates.allowance_length > 0.0) {
    allowance += before * std::exp(-point.sound_speed * step.dt / rates.allowance_length);
  }
  const double heat = std::fmin(step.loss, allowance);
  const double of_contact = loose ? 0.0 : step.contact;
  return {.heat = heat,
          .kept = step.loss - heat + cooling + (step.contact - of_contact),
          .cooling = cooling,
          .of_contact = of_contact,
          .allowance = allowance - std::fmax(heat, 0.0)};
}

}  // namespace whipple::transfer::formulas

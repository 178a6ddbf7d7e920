// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/protocols/hugoniot.hpp"

namespace whipple::md {

/// Estimates a shocked state from the energy of the static crystal and a harmonic solid with Grueneisen coefficient
/// 2 V/V0 (docs/theory/molecular_dynamics.md, equation 10); accurate to about 10 %, sufficient as a starting point.
struct HugoniotGuess {
  double specific_volume = 0.0;  ///< m^3/kg
  double temperature = 0.0;      ///< K, at least 100
  double pressure = 0.0;         ///< Pa
};

/// Returns the static crystal at zero pressure as the state ahead of a shock; sufficient for checking a plan.
ReferenceState static_reference(const Potential& potential);

HugoniotGuess guess_hugoniot(const Potential& potential, const ReferenceState& reference,
                             double specific_volume);

/// Returns the end of searches along the estimated Hugoniot (m^3/kg): 0.3 of the reference volume, or a larger
/// volume if the energy of the static crystal is not known down to there.
double least_guess_volume(const Potential& potential, const ReferenceState& reference);

/// Estimates the Hugoniot state at a pressure (Pa).
/// @throws StateError if the pressure is not reached down to `least_guess_volume`.
HugoniotGuess guess_hugoniot_at_pressure(const Potential& potential, const ReferenceState& reference,
                                         double pressure);

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/protocols/hugoniot.hpp"

namespace whipple::md {

/// Where a shock leads to, from the energy of the static crystal and a harmonic solid with Grueneisen
/// coefficient 2 V/V0 (docs/theory/molecular_dynamics.md, equation 10): good to about a tenth, enough to
/// begin with.
struct HugoniotGuess {
  double specific_volume = 0.0;  ///< m^3/kg
  double temperature = 0.0;      ///< K, at least 100
  double pressure = 0.0;         ///< Pa
};

/// The static crystal at zero pressure as the state before a shock: enough for a first look at a plan.
ReferenceState static_reference(const Potential& potential);

HugoniotGuess guess_hugoniot(const Potential& potential, const ReferenceState& reference,
                             double specific_volume);

/// Where searches along the guessed Hugoniot end: 0.3 of the reference volume, or earlier if the energy of
/// the static crystal is not known so far. m^3/kg
double least_guess_volume(const Potential& potential, const ReferenceState& reference);

/// Guesses the Hugoniot state at a pressure (Pa).
/// @throws StateError if the pressure is not reached down to `least_guess_volume`.
HugoniotGuess guess_hugoniot_at_pressure(const Potential& potential, const ReferenceState& reference,
                                         double pressure);

}  // namespace whipple::md

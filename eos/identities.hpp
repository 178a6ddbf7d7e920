// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/equation_of_state.hpp"

/// Checks identities that every thermodynamically consistent equation of state satisfies, by finite differences
/// through the public interface (docs/theory/equations_of_state.md, section 5).
namespace whipple::eos {

/// Holds relative defects at one state; each is divided by the scale given after it. NaN: the model does not
/// provide a quantity, or the stencil leaves the phase of the state.
struct IdentityDefects {
  double pressure = State::unknown;        ///< P - [T (dP/dT)_V - (dE/dV)_T]; |P| + T |dP/dT| + |dE/dV|
  double sound_speed = State::unknown;     ///< c^2 - V^2 [P (dP/dE)_V - (dP/dV)_E]; the sum of the magnitudes
  double heat_capacity = State::unknown;   ///< C_v - (dE/dT)_V; C_v
  double gruneisen = State::unknown;       ///< Gamma - V (dP/dE)_V; |Gamma| + 1
  double bulk_modulus = State::unknown;    ///< K_T + V (dP/dV)_T; |K_T| + rho c^2
  double entropy_energy = State::unknown;  ///< T (dS/dE)_V - 1; 1
  double entropy_volume = State::unknown;  ///< T (dS/dV)_E - P; |P| + rho c^2
  double round_trip = State::unknown;      ///< E(V, T(V, E)) - E; |E| + C_v T

  /// Returns the largest known defect.
  [[nodiscard]] double largest() const;
};

/// Computes the defects by eighth-order central differences with a relative step in volume and temperature.
/// @param step 1e-3 balances truncation and round-off for smooth models
IdentityDefects check_identities(const EquationOfState& eos, double density, double specific_internal_energy,
                                 double step = 1e-3);

}  // namespace whipple::eos

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "eos/equation_of_state.hpp"

namespace whipple::eos {

/// Holds one point of an isentrope.
struct IsentropeState {
  State state;
  double riemann_velocity = 0;  ///< integral of c d(rho)/rho from the start, m/s (negative on expansion)
};

/// Computes the isentrope through a state, de = p/rho^2 d(rho) (L2), integrated with error control (relative
/// 1e-10), at the given densities (monotone, on one side of the start).
std::vector<IsentropeState> isentrope(const EquationOfState& eos, const State& start,
                                      const std::vector<double>& densities);

/// Follows the isentrope to a pressure on the surface of the model (a liquid may carry tension).
/// @throws StateError if the isentrope turns around before it reaches the pressure; the message includes the location
IsentropeState isentrope_at_pressure(const EquationOfState& eos, const State& start, double pressure);

/// Holds the result of a release (or isentropic compression) to a pressure.
struct Release {
  IsentropeState end;
  /// Whether the end is an equilibrium mixture of liquid and vapour: `end.state` holds density, energy, temperature
  /// and fractions of the mixture; sound speed and Riemann velocity are undefined (NaN).
  bool in_equilibrium = false;
};
/// Releases a state to a pressure. If the model has a liquid-vapour dome at the pressure and the initial entropy is
/// inside it, the end is the equilibrium mixture (lever rule on the entropy, L4); otherwise `isentrope_at_pressure`.
/// @throws StateError as `isentrope_at_pressure`
Release release(const EquationOfState& eos, const State& start, double pressure);

}  // namespace whipple::eos

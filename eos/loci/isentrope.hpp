// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "eos/equation_of_state.hpp"

namespace whipple::eos {

/// One point of an isentrope.
struct IsentropeState {
  State state;
  double riemann_velocity = 0;  ///< integral of c d(rho)/rho from the start, m/s (negative on expansion)
};

/// Isentrope through a state, de = p/rho^2 d(rho) (L2), integrated with error control (relative 1e-10), at
/// the asked densities (monotone, on one side of the start).
std::vector<IsentropeState> isentrope(const EquationOfState& eos, const State& start,
                                      const std::vector<double>& densities);

/// Follows the isentrope up or down to a pressure, on the surface of the model itself (a liquid may carry
/// tension).
/// @throws StateError if the isentrope turns around before it reaches the pressure; the message says where
IsentropeState isentrope_at_pressure(const EquationOfState& eos, const State& start, double pressure);

/// Release (or isentropic compression) to a pressure.
struct Release {
  IsentropeState end;
  /// The end is an equilibrium mixture of liquid and vapour: `end.state` holds the mixture's density, energy,
  /// temperature and fractions; sound speed and Riemann velocity are not defined (NaN).
  bool in_equilibrium = false;
};
/// If the model has a liquid-vapour dome at the pressure and the entropy of the start lies in it, the end is
/// the equilibrium mixture (lever rule on the entropy, L4); otherwise `isentrope_at_pressure`.
/// @throws StateError as that does
Release release(const EquationOfState& eos, const State& start, double pressure);

}  // namespace whipple::eos

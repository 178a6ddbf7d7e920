// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "eos/equation_of_state.hpp"

/// Finds states from pairs of variables that no model evaluates directly. All searches are bracketed and bounded by
/// the range of the model (docs/theory/equations_of_state.md, section 4); SI. Where several states have the
/// requested pair, the documented one is returned; where there is none, the error names the violated bound.
namespace whipple::eos {

/// Returns the state at pressure and temperature on the branch of the isotherm through a starting density, reached
/// from there by compression or expansion without crossing a spinodal. From the reference density, the condensed
/// branch (for a gas the only one); from a dilute state, the vapour below the critical temperature.
/// @param from  starting density (kg/m^3); the reference density if nothing
/// @throws StateError if the isotherm turns, or the model ends, before it reaches the pressure
State state_at_pressure_and_temperature(const EquationOfState& eos, double pressure, double temperature,
                                        std::optional<double> from = std::nullopt);

/// Returns the density of `state_at_pressure_and_temperature`.
double density_at_pressure(const EquationOfState& eos, double pressure, double temperature);

/// Returns the state at pressure and density: solves p(rho, e) = pressure for e. Returns the coldest solution where
/// the pressure decreases with energy somewhere (negative Grueneisen parameter).
/// @throws StateError if the pressure is below that of the coldest state at the density, or beyond the model
State state_at_pressure(const EquationOfState& eos, double density, double pressure);

/// Returns the state at specific entropy and density: solves s(rho, e) = entropy for e.
/// @throws StateError if the entropy is below that of the coldest state at the density, beyond the model, or the
/// model has no entropy
State state_at_entropy(const EquationOfState& eos, double density, double entropy);

}  // namespace whipple::eos

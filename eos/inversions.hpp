// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "eos/equation_of_state.hpp"

/// States from the pairs of variables that no model answers by itself. All searches are bracketed and bounded
/// by the model's own range (docs/theory/equations_of_state.md, section 4); SI. Where several states have the
/// asked pair, the documented one is taken; where none has it, the error says which bound was met.
namespace whipple::eos {

/// State at pressure and temperature on the isotherm's branch through a starting density: the one reached
/// from there by compression or expansion without crossing a spinodal. From the reference density, the
/// condensed branch (of a gas the only one); from a thin state, the vapour below the critical temperature.
/// @param from  density to start at (kg/m^3); the reference density if nothing
/// @throws StateError if the isotherm turns, or the model ends, before it reaches the pressure
State state_at_pressure_and_temperature(const EquationOfState& eos, double pressure, double temperature,
                                        std::optional<double> from = std::nullopt);

/// Its density.
double density_at_pressure(const EquationOfState& eos, double pressure, double temperature);

/// State at pressure and density: solves p(rho, e) = pressure for e. The coldest one, where the pressure
/// falls with the energy somewhere (Grueneisen parameter below zero).
/// @throws StateError if the pressure lies below the coldest state at the density, or beyond the model
State state_at_pressure(const EquationOfState& eos, double density, double pressure);

/// State at specific entropy and density: solves s(rho, e) = entropy for e.
/// @throws StateError if the entropy lies below that of the coldest state at the density, beyond the model,
/// or the model knows none
State state_at_entropy(const EquationOfState& eos, double density, double entropy);

}  // namespace whipple::eos

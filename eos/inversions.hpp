// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/equation_of_state.hpp"

/// States from the pairs of variables that no model answers by itself. All searches are bracketed and bounded
/// by the model's own range (docs/theory/equations_of_state.md, section 4); SI.
namespace whipple::eos {

/// Density at pressure and temperature on the condensed branch: the one reached from the reference density by
/// compression or expansion without crossing a spinodal.
/// @throws StateError if the isotherm turns before it reaches the pressure; the message says where
double density_at_pressure(const EquationOfState& eos, double pressure, double temperature);

/// State at pressure and density: solves p(rho, e) = pressure for e.
/// @throws StateError if the pressure lies below the coldest state at the density
State state_at_pressure(const EquationOfState& eos, double density, double pressure);

/// State at specific entropy and density: solves s(rho, e) = entropy for e.
/// @throws StateError if the entropy lies below that of the coldest state at the density, or the model knows
/// none
State state_at_entropy(const EquationOfState& eos, double density, double entropy);

}  // namespace whipple::eos

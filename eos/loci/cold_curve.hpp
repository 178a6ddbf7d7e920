// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/equation_of_state.hpp"

namespace whipple::eos {

/// Returns the coldest state described by the model at a density: a point of the cold curve.
State cold_state(const EquationOfState& eos, double density);

/// Holds characteristic states of the cold curve of condensed material: zero pressure, compression limit and limit
/// in tension.
struct ColdCurve {
  State at_rest;        ///< p = 0
  State tension_limit;  ///< minimum pressure: the ideal strength in tension; without phase if there is none
  State compression_limit;  ///< largest density up to which p increases, at most the model's limit
  /// J/kg from rest to one millionth of the reference density; NaN if this is outside the model, or the model
  /// carries unlimited tension
  double cohesive_energy = State::unknown;
};
/// Computes the cold curve. @throws StateError if the model has no cold state of zero pressure (a gas)
ColdCurve cold_curve(const EquationOfState& eos);

}  // namespace whipple::eos

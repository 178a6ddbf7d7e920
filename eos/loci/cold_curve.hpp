// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/equation_of_state.hpp"

namespace whipple::eos {

/// The coldest state that the model describes at a density: a point of the cold curve.
State cold_state(const EquationOfState& eos, double density);

/// Characteristic states of the cold curve of condensed material: zero pressure, compression limit and limit
/// in tension.
struct ColdCurve {
  State at_rest;            ///< p = 0
  State tension_limit;      ///< least pressure: the ideal strength in tension; without phase if there is none
  State compression_limit;  ///< the greatest density to which p rises, at most the model's own limit
  /// J/kg from rest to one millionth of the reference density; NaN if the model does not go there, or bears
  /// any tension
  double cohesive_energy = State::unknown;
};
/// @throws StateError if the model has no cold state of zero pressure (a gas)
ColdCurve cold_curve(const EquationOfState& eos);

}  // namespace whipple::eos

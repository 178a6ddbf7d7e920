// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/loci/hugoniot.hpp"

namespace whipple::eos {

/// Holds the state of two materials at their interface: equal pressure, equal velocity.
struct ImpedanceMatch {
  double pressure = 0;              ///< Pa
  double velocity = 0;              ///< of the interface, m/s
  State left;                       ///< the impactor, or the material of the incident shock
  State right;                      ///< the target, or the material of the transmitted shock
  double right_shock_velocity = 0;  ///< m/s, against the material ahead
  /// m/s, of the shock reflected into the left material, relative to that material; NaN for a release wave or no
  /// reflection
  double left_shock_velocity = 0;
};

/// Computes the planar impact of `impactor` with `velocity` on `target` at rest. Both Hugoniots may start from any
/// state (porous, preheated), at equal pressure.
/// @throws StateError if the range of a model ends before the pressures are equal
ImpedanceMatch match_impact(const Hugoniot& impactor, const Hugoniot& target, double velocity);

/// Computes the interaction of a shock in the left material with the right one, which is at rest: the left material
/// is reshocked (stiffer right material) or released (softer), on its equation of state.
/// @param incident  the state behind the shock in the left material
ImpedanceMatch match_shock(const EquationOfState& left, const ShockState& incident, const Hugoniot& right);

/// Returns the free-surface velocity of the left material after the incident shock: release to a pressure.
double free_surface_velocity(const EquationOfState& eos, const ShockState& incident, double pressure = 0);

}  // namespace whipple::eos

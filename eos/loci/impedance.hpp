// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/loci/hugoniot.hpp"

namespace whipple::eos {

/// Two materials at their interface: equal pressure, equal velocity.
struct ImpedanceMatch {
  double pressure = 0;              ///< Pa
  double velocity = 0;              ///< of the interface, m/s
  State left;                       ///< the impactor, or the material that the shock comes from
  State right;                      ///< the target, or the material that the shock enters
  double right_shock_velocity = 0;  ///< m/s, against the material ahead
  /// m/s, of the shock that goes back into the left material, against that material; NaN if a release or
  /// nothing goes back
  double left_shock_velocity = 0;
};

/// Planar impact: `impactor` with `velocity` onto `target` at rest. Both Hugoniots may begin from any state
/// (porous, preheated), at equal pressure.
/// @throws StateError if one of the materials ends before they agree
ImpedanceMatch match_impact(const Hugoniot& impactor, const Hugoniot& target, double velocity);

/// A shock that has passed through the left material meets the right one, which is at rest: the left material
/// is shocked again (right one stiffer) or released (softer), on its own surface.
/// @param incident  the state behind the shock in the left material
ImpedanceMatch match_shock(const EquationOfState& left, const ShockState& incident, const Hugoniot& right);

/// Velocity of the left material's free surface after the incident shock: release to a pressure.
double free_surface_velocity(const EquationOfState& eos, const ShockState& incident, double pressure = 0);

}  // namespace whipple::eos

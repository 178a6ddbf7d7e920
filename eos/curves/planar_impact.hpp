// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "eos/equation_of_state.hpp"

namespace whipple::eos::curves {

/// Holds one side of an impact.
struct ImpactSide {
  State shocked;
  std::optional<State> released;  ///< to zero pressure; none outside the range of the model
};

/// Holds a planar impact, computed from the equations of state alone.
struct PlanarImpact {
  double pressure = 0.0;                        ///< Pa, behind both shocks
  double interface_velocity = 0.0;              ///< m/s
  std::optional<double> free_surface_velocity;  ///< m/s, of the target; none outside the range of the model
  ImpactSide projectile, target;
};

/// Computes the planar impact of a projectile with a velocity (m/s) on a target at rest, both from their reference
/// states.
/// @throws StateError if the range of a model ends before the pressures are equal
PlanarImpact planar_impact(const EquationOfState& projectile, const EquationOfState& target, double velocity);

}  // namespace whipple::eos::curves

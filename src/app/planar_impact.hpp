// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "src/case/case.hpp"

namespace whipple::app {

/// Computes the planar impact of the fastest body of a case on each other body from their equations of state alone.
/// Returns a list of {projectile, target, velocity (m/s, along the axis), pressure (Pa), interface_velocity,
/// free_surface_velocity (m/s, of the target; null without one), states: [{body, material, shocked: {...}, released:
/// {...} or null}]} with density (kg/m^3), temperature (K), melted_fraction, vaporised_fraction. Bodies of the same
/// material count once. The list is empty if nothing moves; impacts outside the range of a model are omitted.
/// @param axis  of the impact: 0, 1, 2
nlohmann::json planar_impacts(const cases::Case& setup, int axis);

}  // namespace whipple::app

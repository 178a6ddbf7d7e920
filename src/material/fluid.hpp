// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "src/material/fluid_formulas.hpp"
#include "src/material/material.hpp"
#include "src/particles/material_points.hpp"

namespace whipple {

/// Returns when a material has no shear strength.
inline Fluidity fluidity(const Material& material) {
  if (!material.eos->condensed() && !material.strength->carries_deviator()) return Fluidity::always;
  return material.eos->has_phases() ? Fluidity::when_molten : Fluidity::never;
}

/// Returns whether a point is a fluid that fills its volume.
inline bool is_filling_fluid(Fluidity fluidity, const MaterialPoints& points, std::size_t p) {
  return is_filling_fluid(fluidity, points.pressure[p], points.void_volume[p], points.melted_fraction[p],
                          points.vaporised_fraction[p]);
}

/// Returns whether a filling fluid is also continuous: not failed, unless more than half of it is vapour.
inline bool is_continuous_fluid(Fluidity fluidity, const MaterialPoints& points, std::size_t p) {
  return is_filling_fluid(fluidity, points, p) &&
         (points.failed[p] == failure::intact || points.vaporised_fraction[p] > 0.5);
}

/// Returns whether a point has less than half of its initial density (kg/m^3).
inline bool has_thinned(const MaterialPoints& points, std::size_t p, double initial_density) {
  return points.mass[p] < 0.5 * initial_density * points.volume[p];
}

}  // namespace whipple

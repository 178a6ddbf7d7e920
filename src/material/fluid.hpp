// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/material/material.hpp"
#include "src/particles/material_points.hpp"

namespace whipple {

/// States when a material has no shear strength.
enum class Fluidity : std::uint8_t {
  never,
  when_molten,  ///< if liquid, vapour or burnt: its equation of state has phases
  always,       ///< gas, or detonation products: no tension either
};

inline Fluidity fluidity(const Material& material) {
  if (!material.eos->condensed() && !material.strength->carries_deviator()) return Fluidity::always;
  return material.eos->has_phases() ? Fluidity::when_molten : Fluidity::never;
}

/// Returns whether a point is a fluid that fills its volume: without shear strength, under pressure, without a void.
/// Liquid that breaks into drops does not: in tension it fails, its void opens and its pressure is 0.
inline bool is_filling_fluid(Fluidity fluidity, const MaterialPoints& points, std::size_t p) {
  if (fluidity == Fluidity::never || !(points.pressure[p] > 0.0) || points.void_volume[p] > 0.0) return false;
  return fluidity == Fluidity::always ||
         shear_bearing_fraction(points.melted_fraction[p], points.vaporised_fraction[p]) <= 0.0;
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

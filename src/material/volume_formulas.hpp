// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "src/core/base/dialect.hpp"

/// Change of the volume of one point in a step (docs/theory/material.md, eq. 1, 11).
namespace whipple::material::formulas {

constexpr double least_volume_ratio = 0.5;  ///< limits of J in one step; stated in the report
constexpr double greatest_volume_ratio = 2.0;
/// Minimum density as a fraction of the reference density. Thinner material does not expand further: it then fills far
/// more than the nodes on which its pressure acts, and without a bound isolated vapour would grow by the same factor in
/// every step.
constexpr double least_density_ratio = 1e-9;

/// Maximum density as a fraction of the density at which the equation of state ends.
constexpr double greatest_density_ratio = 0.999;

/// Returns J, limited.
/// @param room  greatest J that keeps the density above its minimum, >= 1
WHIPPLE_POINT inline double limited_ratio(double ratio, double room) {
  const double least = least_volume_ratio,
               greatest = greatest_volume_ratio;  // kernels cannot refer to constants
  return std::min(std::clamp(ratio, least, greatest), room);
}

/// Returns the volume of the material of a point with a void.
/// @param volume  of the material before the step, m^3
/// @param share   part of the change of the total that the void takes
/// @param before, total  volume of material and void before and after the step, m^3
WHIPPLE_POINT inline double volume_beside_void(double volume, double share, double before, double total) {
  return std::min(volume + (1.0 - share) * (total - before), total);
}

}  // namespace whipple::material::formulas

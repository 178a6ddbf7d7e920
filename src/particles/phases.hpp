// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "src/core/base/dialect.hpp"

/// Phases of a point: what counts as melted, and what still carries shear.
namespace whipple {

constexpr double never = -1.0;        ///< time of an event that has not occurred, s
constexpr double melted_share = 0.5;  ///< melted mass fraction that counts as melted

/// Returns the mass fraction of a solid that carries shear: 1 - melted; 0 in the presence of vapour, which fills the
/// volume even if most of the mass is still solid.
WHIPPLE_POINT inline double shear_bearing_fraction(double melted_fraction, double vaporised_fraction) {
  return vaporised_fraction > 0.0 ? 0.0 : 1.0 - melted_fraction;
}

/// Lists the phases as numbered in the output files and the phase masses of history.csv.
enum class Phase : std::uint8_t { solid = 0, melting = 1, liquid = 2, vapour = 3 };

/// Returns the phase of a point from its mass fractions: vapour if at least half of the mass is vapour; otherwise solid
/// below 1 % of melt, liquid above 99 %, melting between. The margins prevent points at the edge of the melting range
/// (where round-off causes a fraction of 1e-12) from being counted as melting.
constexpr double least_vapour = 0.5, least_melting = 0.01, greatest_melting = 0.99;
WHIPPLE_POINT constexpr Phase phase(double melted_fraction, double vaporised_fraction) {
  if (vaporised_fraction >= least_vapour) return Phase::vapour;
  if (melted_fraction < least_melting) return Phase::solid;
  return melted_fraction <= greatest_melting ? Phase::melting : Phase::liquid;
}

}  // namespace whipple

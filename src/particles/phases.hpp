// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace whipple

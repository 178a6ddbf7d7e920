// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "src/core/base/dialect.hpp"
#include "src/particles/phases.hpp"

namespace whipple {

/// States when a material has no shear strength.
enum class Fluidity : std::uint8_t {
  never,
  when_molten,  ///< if liquid, vapour or burnt: its equation of state has phases
  always,       ///< gas, or detonation products: no tension either
};

/// Returns whether a point is a fluid that fills its volume: without shear strength, under pressure, without a void.
/// Liquid that breaks into drops does not: in tension it fails, its void opens and its pressure is 0.
WHIPPLE_POINT inline bool is_filling_fluid(Fluidity fluidity, double pressure, double void_volume,
                                           double melted_fraction, double vaporised_fraction) {
  if (fluidity == Fluidity::never || !(pressure > 0.0) || void_volume > 0.0) return false;
  return fluidity == Fluidity::always || shear_bearing_fraction(melted_fraction, vaporised_fraction) <= 0.0;
}

}  // namespace whipple

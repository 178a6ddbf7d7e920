// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/registers.hpp"

/// Division of the volume of one point between material and voids (docs/theory/material.md, eq. 12, 13, 18).
namespace whipple::material::formulas {

constexpr double greatest_void_step = 0.1;  ///< |dV/V| of material beside its void in one step

/// Point with cracks or voids. Number is double, or a register of points.
template <class Number>
struct PorousPoint {
  Number pressure;  ///< Pa, that acts
  Number volume;    ///< m^3 of material
  Number void_volume;
};

/// Result of a comparison.
template <class Number>
using Mask = decltype(Number{} < Number{});

/// Divided volume, and whether the point was kept from changing more in one step.
template <class Number>
struct SharedVolume {
  PorousPoint<Number> point;
  Mask<Number> limited;
};

/// Returns pressure and division of the volume into material and void: the fraction `opening` of what exceeds the volume
/// of zero pressure, or of the pressure `least` where it is all of it, is void. Tension opens the void, pressure lets
/// the material grow into it.
/// @param modulus  rho c^2 (Pa), bounded from below
/// @param least    Pa, <= 0
template <class Number>
WHIPPLE_POINT inline SharedVolume<Number> share_volume(const PorousPoint<Number>& point, Number modulus,
                                                       Number opening, Number least) {
  const Number pressure = point.pressure, volume = point.volume, total = volume + point.void_volume;
  const Number limit = broadcast<Number>(greatest_void_step);
  const Number wanted = (pressure - least) / modulus;
  const Number strain = minimum(maximum(wanted, -limit), limit);
  const Number relaxed = volume + strain * volume, excess = total - relaxed;
  const auto whole = opening == 1.0, open = excess > 0.0;
  const Number matter = select(whole, relaxed, total - opening * excess);
  const Number cracked = minimum(pressure + modulus * (volume - matter) / volume, Number{});
  const Number closed = maximum(pressure - modulus * point.void_volume / volume, least);
  return {{select(open, select(whole, least, cracked), closed), select(open, matter, total),
           select(open, total - matter, Number{})},
          Mask<Number>((opening > 0.0) & open & (strain != wanted))};
}

}  // namespace whipple::material::formulas

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "src/core/base/dialect.hpp"

/// Artificial viscosity of one point (docs/theory/material.md, eq. 8; docs/theory/dissipation.md, eq. 6), with
/// the coefficients of `UpdateSettings`.
namespace whipple::material::formulas {

/// Returns the artificial viscosity rho w (c2 w + c1 c) of a closing speed w = l |D|, Pa (eq. 8).
/// @param closing  w, m/s
template <class Settings, class T>
WHIPPLE_POINT inline T artificial_viscosity(const Settings& settings, T density, T closing, T sound_speed) {
  return density * closing *
         (settings.quadratic_viscosity * closing + settings.linear_viscosity * sound_speed);
}

/// Returns the tension by which viscosity resists expansion, at most the pressure, Pa.
/// @param opening  l D, m/s, >= 0
template <class Settings, class T>
WHIPPLE_POINT inline T expansion_viscosity(const Settings& settings, T density, T opening, T sound_speed,
                                           T pressure) {
  const T viscosity = density * opening * settings.expansion_viscosity * sound_speed;
  return std::min(viscosity, std::max(pressure, T{}));
}

/// Returns the closing speed whose viscosity heats (dissipation, eq. 6), m/s: that of the grid, less what exceeds the
/// affine field of the particle in material that is not compressed yet.
/// @param of_grid, of_field  closing speeds by either velocity gradient, m/s, >= 0
/// @param compression        rho/rho_0 - 1
template <class Settings, class T>
WHIPPLE_POINT inline T heating_closing_speed(const Settings& settings, T of_grid, T of_field, T compression,
                                             double per_range) {
  const T share = std::clamp(1.0 - compression * per_range, 0.0, 1.0);
  return of_grid - share * std::max(of_grid - settings.affine_gain * of_field, T{});
}

/// Returns the part of the artificial viscosity whose work is heat (dissipation, eq. 5 and 6), Pa: all of it in a shock,
/// whose rate the affine field of the particle follows; at first contact the part of the jump that the affine field
/// represents; all of it in fragmented material, which collides.
/// @param length  l, m
/// @param whole   artificial viscosity, Pa
template <class Settings, class T>
WHIPPLE_POINT inline T heating_viscosity(const Settings& settings, T length, T divergence,
                                         T affine_divergence, T density, T sound_speed, bool intact, T whole,
                                         double per_initial, double per_range) {
  const T of_grid = std::max(-divergence, 0.0) * length;
  const T of_field = std::max(-affine_divergence, 0.0) * length;
  const T compression = density * per_initial - 1.0;
  const T closing = heating_closing_speed(settings, of_grid, of_field, compression, per_range);
  const T viscosity = artificial_viscosity(settings, density, closing, sound_speed);
  const bool tight = intact && compression >= 0.0;
  return tight && whole > 0.0 ? std::min(viscosity, whole) : whole;
}

}  // namespace whipple::material::formulas

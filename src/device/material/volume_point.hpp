// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src/device/material/material_constants.hpp"
#include "src/device/material/material_point.hpp"
#include "src/material/viscosity_formulas.hpp"
#include "src/material/volume_formulas.hpp"

/// Volume and artificial viscosity of one point (docs/theory/material.md, eq. 1, 8, 11).
namespace whipple::device {

namespace formulas = material::formulas;

/// Holds the motion of a point in the step.
struct PointMotion {
  double ratio;       ///< J
  double divergence;  ///< tr L, 1/s
  double affine_divergence;
};

/// Advances the volumes of material and void.
/// @returns events
WHIPPLE_POINT inline std::uint32_t advance_volume(const MaterialConstants& material, double ratio,
                                                  MaterialState& state) {
  using namespace formulas;
  std::uint32_t events = 0;
  const double old_volume = state.volume, mass = state.mass;
  const double per_least_density = 1.0 / (least_density_ratio * material.reference_density);
  const double room = std::max(mass / old_volume * per_least_density, 1.0);
  const double limited = limited_ratio(ratio, room);
  if (ratio < least_volume_ratio || ratio > greatest_volume_ratio) events |= event::limited_volume_change;
  const double greatest = greatest_volume_ratio;
  if (std::min(ratio, greatest) > room) events |= event::limited_density;
  state.volume = old_volume * limited;
  if (state.void_volume > 0.0) {
    const double before = old_volume + state.void_volume, total = before * limited;
    const double share = state.intact() ? state.void_volume / before : 1.0;
    state.volume = volume_beside_void(old_volume, share, before, total);
    state.void_volume = total - state.volume;
  }
  const double least = mass / (greatest_density_ratio * material.maximum_density);
  if (state.volume < least) {
    state.volume = least;
    events |= event::squeezed;
  }
  if (!(state.volume > 0.0) || !std::isfinite(state.energy + state.volume)) events |= event::undefined;
  return events;
}

/// Computes the artificial viscosity and the part of it that heats.
WHIPPLE_POINT inline void advance_viscosity(const MaterialConstants& material, const PointMotion& motion,
                                            double density, MaterialState& state) {
  const double closing = -motion.divergence * material.cell_size;  // l |D|, m/s
  const double compressing = formulas::artificial_viscosity(material, density, closing, state.sound_speed);
  double viscosity = closing > 0.0 ? compressing : 0.0;
  if (material.expansion_viscosity != 0.0) {
    const double opening = std::max(motion.divergence, 0.0) * material.cell_size;
    viscosity -= formulas::expansion_viscosity(material, density, opening, state.sound_speed, state.pressure);
  }
  state.artificial_viscosity = viscosity;
  if (material.heating == HeatingViscosity::whole) state.heating_viscosity = viscosity;
  if (material.heating != HeatingViscosity::of_affine_field) return;
  state.heating_viscosity = formulas::heating_viscosity(
      material, material.cell_size, motion.divergence, motion.affine_divergence, density, state.sound_speed,
      state.intact(), viscosity, 1.0 / material.initial_density, 1.0 / material.affine_compression);
}

}  // namespace whipple::device

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src/device/material/material_constants.hpp"
#include "src/device/material/material_point.hpp"
#include "src/material/failure/code.hpp"
#include "src/material/failure/fracture_formulas.hpp"
#include "src/material/failure/void_growth_formulas.hpp"
#include "src/material/void_formulas.hpp"

/// Failure of one point at the new pressure (docs/theory/material.md, section 5).
namespace whipple::device {

/// Holds what failure depends on beside the state of the point.
struct FailurePoint {
  double dt;                ///< s
  double density;           ///< kg/m^3
  double bulk_sound_speed;  ///< m/s
  double increment;         ///< of the plastic strain
  double divergence;        ///< tr L, 1/s
};

/// Returns the tensile pressure that the point bears, Pa.
WHIPPLE_POINT inline double spall_strength_of(const MaterialConstants& material, const MaterialState& state) {
  return material.spall_strength * (1.0 - state.melted) * state.threshold_factor;
}

/// Holds the pressure at the cut-off: the volume is divided into material and void.
WHIPPLE_POINT inline void cut_off(const MaterialConstants& material, const FailurePoint& at,
                                  MaterialState& state) {
  const double least = -spall_strength_of(material, state);
  const bool is_open = state.void_volume > 0.0;
  if (!state.intact() || (!is_open && state.pressure >= least)) return;
  const double modulus = at.density * at.bulk_sound_speed * at.bulk_sound_speed;
  const material::formulas::PorousPoint<double> shared =
      material::formulas::share_volume<double>({state.pressure, state.volume, state.void_volume}, modulus,
                                               1.0, least)
          .point;
  state.pressure = shared.pressure;
  state.volume = shared.volume;
  state.void_volume = shared.void_volume;
}

/// Grows the voids of material that they weaken at a rate.
WHIPPLE_POINT inline void grow_voids(const VoidGrowthConstants& law, const FailurePoint& at,
                                     MaterialState& state) {
  const double solid = 1.0 - state.melted, strength = law.resistance * solid * state.threshold_factor;
  if (!state.intact() ||
      !failure::formulas::may_grow(law.at_nuclei, strength, state.pressure, state.void_volume)) {
    return;
  }
  state.fail(failure::formulas::grow_voids(law, at.dt, at.density * at.bulk_sound_speed * at.bulk_sound_speed,
                                           solid, strength, state.pressure, state.volume, state.void_volume));
}

/// Accumulates the damage of Johnson-Cook.
/// @returns whether the point fractures
WHIPPLE_POINT inline bool fractures(const JohnsonCookDamageConstants& law, const FailurePoint& at,
                                    MaterialState& state) {
  if (!(at.increment > 0.0) || !state.intact()) return false;
  const double equivalent = std::sqrt(1.5 * material::formulas::squared_norm(state.deviator));
  const double triaxiality = -state.pressure / equivalent;
  // At an equivalent stress of 0 there is no solid.
  if (!(equivalent > 0.0) || triaxiality < law.least_triaxiality || triaxiality > law.greatest_triaxiality) {
    return false;
  }
  const double limit =
      failure::formulas::failure_strain(law, triaxiality, at.increment / at.dt, state.temperature);
  state.damage = std::min(1.0, state.damage + at.increment / (limit * state.threshold_factor));
  return state.damage >= 1.0;
}

/// Evaluates the criteria.
/// @returns whether the point has failed in this step
WHIPPLE_POINT inline bool update_failure(const MaterialConstants& material, const FailurePoint& at,
                                         MaterialState& state) {
  const double before = state.failed;
  const bool heals = (material.heals_tension && before == static_cast<double>(failure::tensile)) ||
                     (material.heals_growth && before == static_cast<double>(failure::void_growth));
  if (heals && !(state.void_volume > 0.0) && state.pressure > 0.0) {
    state.fail(failure::intact);  // the deviator starts from zero
  }
  if (material.voids == VoidKind::cut_off) cut_off(material, at, state);
  if (material.voids == VoidKind::viscous_growth) grow_voids(material.void_growth, at, state);
  for (int i = 0; i < material.criteria; ++i) {
    if (!state.intact()) break;
    switch (material.order[static_cast<std::size_t>(i)]) {
      case CriterionKind::tensile_pressure:
        if (state.pressure < -spall_strength_of(material, state)) {
          state.fail(failure::tensile);
        }
        break;
      case CriterionKind::plastic_strain:
        if (state.plastic_strain > material.failure_strain * state.threshold_factor) {
          state.fail(failure::plastic);
        }
        break;
      case CriterionKind::johnson_cook_damage:
        if (fractures(material.damage, at, state)) state.fail(failure::fractured);
        break;
    }
  }
  if (state.failed == before) return false;
  const bool fails = !state.intact();
  if (material.keeps_fragment_size) {
    state.fragment_size = fails ? failure::formulas::fragment_size(material.energy_per_area, at.density,
                                                                   state.melted, at.divergence)
                                : 0.0;
  }
  return fails;
}

}  // namespace whipple::device

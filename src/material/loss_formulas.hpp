// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "src/core/base/dialect.hpp"
#include "src/core/base/registers.hpp"
#include "src/material/void_formulas.hpp"

/// Loss of strength of one point, or of a register of points (docs/theory/material.md, section 5).
namespace whipple::material::formulas {

constexpr double least_sound_speed_ratio = 0.1;  ///< minimum, as a fraction of the reference bulk sound speed

/// Selects the cause that opens voids in points that have not failed: none, damage, or a tension beyond
/// `least_pressure`.
enum class Opening : std::uint8_t { none, damage, tension };

/// Point at the new pressure, before it loses strength. Number is double, or a register of points.
template <class Number>
struct SolidPoint {
  PorousPoint<Number> porous;
  Number density, melted, vaporised;
  Number damage;          ///< of `Opening::damage`
  Number least_pressure;  ///< of `Opening::tension`: at which voids open, Pa
  Number solid_before;    ///< fraction of the stiffness before the step
  Number solid_modulus;   ///< shear modulus of the solid, Pa
  Number bulk;            ///< squared bulk sound speed, bounded from below
  Number viscosity;       ///< artificial, Pa
  Mask<Number> failed;
};

/// Point after it.
template <class Number>
struct LoosePoint {
  PorousPoint<Number> porous;
  Number viscosity;            ///< artificial, Pa
  Number squared_sound_speed;  ///< longitudinal
  Number kept;                 ///< fraction of the deviator
  Mask<Number> limited;        ///< whether the step of its void was limited
};

/// Reduces the stress of a point that has failed, melts, or contains opening cracks or voids.
/// @param least_squared  least squared sound speed, m^2/s^2
/// @tparam viscous  whether the deviator is that of a viscous fluid, which phases do not reduce
template <Opening kind, bool viscous, class Number>
WHIPPLE_INLINE WHIPPLE_POINT inline LoosePoint<Number> lose_strength(const SolidPoint<Number>& in,
                                                                     double least_squared) {
  constexpr bool brittle = kind == Opening::tension;
  const Mask<Number> failed = in.failed;
  Mask<Number> loose = failed;
  if constexpr (brittle) loose = Number{} == Number{};
  const auto softest = broadcast<Number>(least_squared), one = broadcast<Number>(1.0);
  const Number bearing = select(in.vaporised > 0.0, Number{}, 1.0 - in.melted) * (1.0 - in.damage);
  const Number solid = select(failed, Number{}, bearing);

  const Number opening = select(loose, one, in.damage);
  const Number least = brittle ? select(failed, Number{}, in.least_pressure) : Number{};
  const SharedVolume<Number> divided = share_volume(in.porous, Number(in.density * in.bulk), opening, least);
  const PorousPoint<Number>& shared = divided.point;
  const Mask<Number> parts = opening > 0.0;
  const PorousPoint<Number> after = {select(parts, shared.pressure, in.porous.pressure),
                                     select(parts, shared.volume, in.porous.volume),
                                     select(parts, shared.void_volume, in.porous.void_volume)};

  const Mask<Number> gaping = loose & (after.void_volume > 0.0);  // opened in this step or before
  const Number of_solid = in.bulk + 4.0 / 3.0 * solid * in.solid_modulus / in.density;
  const Mask<Number> slack = (failed & (after.pressure <= 0.0)) | ((!failed) & gaping);
  const Number squared = select(slack, softest, select(failed, in.bulk, of_solid));
  Number of_intact = one, of_failed{};
  if constexpr (viscous) {
    of_failed = select(gaping, Number{}, one);
  } else {
    of_intact = select(solid < in.solid_before, Number(solid / in.solid_before), one);
  }
  return {after, select(gaping, Number{}, in.viscosity), squared, select(failed, of_failed, of_intact),
          divided.limited};
}

}  // namespace whipple::material::formulas

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/device/material/material_constants.hpp"
#include "src/material/strength/johnson_cook_formulas.hpp"
#include "src/material/strength/law_formulas.hpp"

/// Strength of one point: shear modulus, and the increment of the equivalent plastic strain (docs/theory/material.md,
/// eq. 7).
namespace whipple::device {

/// Holds what the return of a point depends on.
struct ReturnPoint {
  double trial;           ///< equivalent trial stress, Pa
  double modulus;         ///< G with the solid fraction, Pa
  double solid;           ///< fraction of the strength that the point retains
  double plastic_strain;  ///< before the step
  double temperature;     ///< K
};

/// Returns the flow stress of Johnson-Cook over its softening, in terms of the increment x of the plastic strain.
struct JohnsonCookFlow {
  const JohnsonCookConstants& law;
  double strain;     ///< before the step
  double per_least;  ///< inverse increment at the reference rate

  WHIPPLE_POINT strength::FlowStress operator()(double x) const {
    const double after = strain + x, rate = std::max(x * per_least, 1.0);
    const double raised =
        law.hardening_coefficient * strength::formulas::power_of_strain(after, law.hardening_exponent);
    const double hardening = law.yield_stress + raised;
    if (!(law.rate_coefficient > 0.0)) return {hardening, raised * law.hardening_exponent / after};
    const double factor = 1.0 + law.rate_coefficient * std::log(rate);
    const double rate_hardening = rate > 1.0 ? law.rate_coefficient / x : 0.0;
    return {hardening * factor,
            raised * law.hardening_exponent / after * factor + hardening * rate_hardening};
  }
};

/// Solves for the increment of Johnson-Cook by Newton's method inside a bracket, from the root for linear hardening.
WHIPPLE_POINT inline double increment_of(const JohnsonCookConstants& law, const ReturnPoint& point,
                                         double dt) {
  const double softening = point.solid * strength::formulas::thermal_softening(law, point.temperature);
  if (!(point.trial > softening * law.yield_stress)) return 0.0;
  const double strain = std::max(point.plastic_strain, 0.0);
  const double power = law.hardening_coefficient > 0.0
                           ? strength::formulas::power_of_strain(strain, law.hardening_exponent)
                           : 0.0;
  const double least = law.yield_stress + law.hardening_coefficient * power;
  const double start = strength::formulas::rate_dependent_start(
      law, {point.trial, 3.0 * point.modulus, softening, strain, power}, law.reference_rate * dt);
  return strength::radial_return_from(start, point.trial, point.modulus, softening, least,
                                      JohnsonCookFlow{law, strain, 1.0 / (law.reference_rate * dt)});
}

struct SteinbergGuinanFlow {
  const SteinbergGuinanConstants& law;
  double strain;

  WHIPPLE_POINT strength::FlowStress operator()(double x) const {
    return strength::formulas::power_hardening(law, strain + x);
  }
};

WHIPPLE_POINT inline double increment_of(const SteinbergGuinanConstants& law, const ReturnPoint& point) {
  if (!(point.trial > point.modulus * (law.yield_stress / law.shear_modulus))) return 0.0;
  const double ratio = point.modulus / law.shear_modulus;  // G/G0, including the solid fraction
  const strength::FlowStress before = strength::formulas::power_hardening(law, point.plastic_strain);
  const double tangent = (point.trial - ratio * before.value) / (3.0 * point.modulus + ratio * before.slope);
  return strength::radial_return_from(tangent, point.trial, point.modulus, ratio, before.value,
                                      SteinbergGuinanFlow{law, point.plastic_strain});
}

/// Returns the shear modulus of the solid in the state before the step, Pa.
template <StrengthKind kind>
WHIPPLE_POINT inline double solid_modulus_of(const MaterialConstants& material, double density,
                                             double pressure, double temperature) {
  if constexpr (kind == StrengthKind::none) return 0.0;
  if constexpr (kind == StrengthKind::steinberg_guinan) {
    const SteinbergGuinanConstants& law = material.steinberg_guinan;
    return law.shear_modulus * strength::formulas::stiffness_ratio(law, density, pressure, temperature);
  }
  return material.shear_modulus;
}

/// Returns the increment of the equivalent plastic strain.
template <StrengthKind kind>
WHIPPLE_POINT inline double increment_by(const MaterialConstants& material, const ReturnPoint& point,
                                         double dt) {
  if constexpr (kind == StrengthKind::none) return 0.0;
  if constexpr (kind == StrengthKind::johnson_cook) return increment_of(material.johnson_cook, point, dt);
  if constexpr (kind == StrengthKind::steinberg_guinan) return increment_of(material.steinberg_guinan, point);
  return strength::formulas::linear_return(material.von_mises, point.trial, point.plastic_strain,
                                           point.modulus, point.solid);
}

}  // namespace whipple::device

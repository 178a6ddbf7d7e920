// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/core/base/dialect.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/material/strength/radial_return.hpp"

/// Formulas of strength models for one point, each from the constants of a law with the members of the structs of the same
/// names (von_mises.hpp, johnson_cook.hpp, steinberg_guinan.hpp).
namespace whipple::strength::formulas {

/// Returns the flow stress of linear hardening up to a plateau (VonMises), Pa.
template <class Law>
WHIPPLE_POINT inline FlowStress linear_hardening(const Law& law, double strain) {
  const double hardened = law.yield_stress + law.hardening_modulus * strain;
  return hardened < law.maximum_flow_stress ? FlowStress{hardened, law.hardening_modulus}
                                            : FlowStress{law.maximum_flow_stress, 0.0};
}

/// Returns the increment of the equivalent plastic strain of linear hardening, in closed form (VonMises).
/// @param trial  equivalent trial stress, Pa, @param modulus  G, Pa, @param solid  fraction that bears
template <class Law>
WHIPPLE_POINT inline double linear_return(const Law& law, double trial, double plastic_strain, double modulus,
                                          double solid) {
  const double yield = solid * linear_hardening(law, plastic_strain).value;
  if (trial <= yield) return 0.0;
  const double hardening = (trial - yield) / (3.0 * modulus + solid * law.hardening_modulus);
  const double plateau = (trial - solid * law.maximum_flow_stress) / (3.0 * modulus);
  return std::max(hardening, plateau);  // the larger one has the smaller flow stress
}

/// Returns G/G0 of SteinbergGuinan, at least 1e-3: so soft a solid has almost no stress, and melting removes the rest.
/// Without a temperature (NaN) of the equation of state there is no softening.
template <class Law, class Number>
WHIPPLE_POINT inline Number stiffness_ratio(const Law& law, Number density, Number pressure,
                                            Number temperature) {
  const Number compression = exponential(natural_log(Number(density / law.reference_density)) / 3.0);
  const Number thermal =
      select(temperature == temperature, law.temperature_coefficient * (temperature - 300.0), Number{});
  return maximum(Number(1.0 + law.pressure_coefficient * pressure / compression - thermal),
                 broadcast<Number>(1e-3));
}

/// Returns the flow stress of SteinbergGuinan at 300 K and zero pressure, with its slope, Pa.
template <class Law>
WHIPPLE_POINT inline FlowStress power_hardening(const Law& law, double plastic_strain) {
  const double base = 1.0 + law.hardening_coefficient * (plastic_strain + law.initial_plastic_strain);
  const double power = law.yield_stress * std::pow(base, law.hardening_exponent);
  if (power >= law.maximum_flow_stress) return {law.maximum_flow_stress, 0.0};
  return {power, power * law.hardening_exponent * law.hardening_coefficient / base};
}

/// Returns 1 - T*^m of JohnsonCook; without a temperature (NaN) of the equation of state there is no softening.
template <class Law>
WHIPPLE_POINT inline double thermal_softening(const Law& law, double temperature) {
  const double homologous =
      (temperature - law.reference_temperature) / (law.melting_temperature - law.reference_temperature);
  if (!(homologous > 0.0)) return 1.0;
  return homologous >= 1.0 ? 0.0 : 1.0 - std::pow(homologous, law.thermal_exponent);
}

}  // namespace whipple::strength::formulas

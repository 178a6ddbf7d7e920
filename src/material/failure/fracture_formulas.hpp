// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "src/core/base/dialect.hpp"
#include "src/core/base/vector_math.hpp"

/// Formulas of failure criteria for one point, or for a register of points.
namespace whipple::failure::formulas {

constexpr double tested_triaxiality = 1.5;  ///< of the tests behind the constants of JohnsonCookDamage

/// Returns the failure strain of a law with the constants of JohnsonCookDamage. Without a temperature (NaN) of the equation
/// of state there is no softening.
/// @param rate  of the plastic strain, 1/s
template <class Law, class Number>
WHIPPLE_POINT inline Number failure_strain(const Law& law, Number triaxiality, Number rate,
                                           Number temperature) {
  const auto one = broadcast<Number>(1.0),
             greatest_exponent = broadcast<Number>(100.0);  // strong compression: no damage, and no overflow
  const Number shape =
      law.d1 + law.d2 * exponential(minimum(
                            Number(law.d3 * minimum(triaxiality, broadcast<Number>(tested_triaxiality))),
                            greatest_exponent));
  const Number fast = 1.0 + law.d4 * natural_log(maximum(Number(rate / law.reference_rate), one));
  const Number homologous =
      (temperature - law.reference_temperature) / (law.melting_temperature - law.reference_temperature);
  const Number hot = 1.0 + law.d5 * select(homologous > 0.0, minimum(homologous, one), Number{});
  return maximum(Number(shape * fast * hot), broadcast<Number>(law.least_failure_strain));
}

/// Returns the size (m) of the fragments of a point that fails (FragmentSize); 0: none.
/// @param energy_per_area  Gamma, J/m^2, @param melted  mass fraction, @param rate  volumetric strain rate, 1/s
WHIPPLE_POINT inline double fragment_size(double energy_per_area, double density, double melted,
                                          double rate) {
  const double root = std::cbrt(rate);
  if (!(root > 0.0)) return 0.0;
  return std::cbrt(24.0 * energy_per_area * (1.0 - melted) / density) / (root * root);
}

}  // namespace whipple::failure::formulas

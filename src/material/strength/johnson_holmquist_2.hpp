// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/material/strength/brittle.hpp"

namespace whipple::strength {

/// Johnson-Holmquist 2, ceramics and glass. Strength over sigma_HEL = 3/2 (HEL - P_HEL), pressure over P_HEL:
///   Y* = Yi* - D (Yi* - Yf*),  Yi* = A (P* + T*)^N f,  Yf* = min(B P*^M f, bound),
///   f = 1 + C ln max(1, rate/rate_0),  dD = dep/eps_f,  eps_f = D1 (P* + T*)^D2,  P >= -T (1 - D);
/// the fraction beta of the shear energy released by damage becomes pressure (bulking). Source: G. R. Johnson, T. J.
/// Holmquist, in High-Pressure Science and Technology 1993, AIP Conf. Proc. 309 (1994) 981-984; input and constants: D.
/// S. Cronin et al., 4th European LS-DYNA Users Conf. (2003). docs/theory/concrete_and_ceramics.md, section 4.
struct JohnsonHolmquist2 : ElasticConstants {
  double hugoniot_elastic_limit = 0.0;                                          ///< HEL, Pa
  double pressure_at_elastic_limit = 0.0;                                       ///< P_HEL, Pa
  double tensile_strength = 0.0;                                                ///< T, Pa
  double intact_coefficient = 0.0;                                              ///< A
  double intact_exponent = 0.0;                                                 ///< N
  double fractured_coefficient = 0.0;                                           ///< B
  double fractured_exponent = 0.0;                                              ///< M
  double maximum_fractured_strength = std::numeric_limits<double>::infinity();  ///< over sigma_HEL
  double rate_coefficient = 0.0;                                                ///< C
  double reference_rate = 1.0;                                                  ///< 1/s
  double damage_coefficient = 0.0;                                              ///< D1
  double damage_exponent = 0.0;                                                 ///< D2
  double bulking = 1.0;                                                         ///< beta

  static ParameterTable<JohnsonHolmquist2> parameters() {
    using P = JohnsonHolmquist2;
    return ElasticConstants::parameters<P>(
        {real("hugoniot_elastic_limit", &P::hugoniot_elastic_limit, "Pa", range::positive(), "HEL"),
         real("pressure_at_elastic_limit", &P::pressure_at_elastic_limit, "Pa", range::positive(),
              "P_HEL: pressure at the Hugoniot elastic limit"),
         real("tensile_strength", &P::tensile_strength, "Pa", range::non_negative(),
              "T: tensile strength of undamaged material, a pressure"),
         real("intact_coefficient", &P::intact_coefficient, "", range::positive(), "A"),
         real("intact_exponent", &P::intact_exponent, "", range::non_negative(), "N"),
         real("fractured_coefficient", &P::fractured_coefficient, "", range::non_negative(), "B"),
         real("fractured_exponent", &P::fractured_exponent, "", range::positive(), "M"),
         real("maximum_fractured_strength", &P::maximum_fractured_strength, "", range::non_negative(),
              "bound of the strength of fractured material, over 3/2 (HEL - P_HEL)")
             .optional(),
         real("rate_coefficient", &P::rate_coefficient, "", range::non_negative(), "C").optional(),
         real("reference_rate", &P::reference_rate, "1/s", range::positive(),
              "strain rate at and below which the rate factor is 1")
             .optional(),
         real("damage_coefficient", &P::damage_coefficient, "", range::non_negative(),
              "D1; 0: breaks at once where it yields"),
         real("damage_exponent", &P::damage_exponent, "", range::non_negative(), "D2"),
         real("bulking", &P::bulking, "", range::between(0.0, 1.0),
              "beta: fraction of the lost shear energy that becomes pressure")
             .optional()});
  }
  static constexpr const char* name = "johnson_holmquist_2";
  static constexpr const char* summary =
      "ceramics and glass: pressure, damage, strain rate, bulking (Johnson-Holmquist 2)";
  static constexpr const char* theory =
      "Y* = Yi* - D (Yi* - Yf*), Yi* = A (P* + T*)^N f, Yf* = min(B P*^M f, bound), f = 1 + C ln max(1, "
      "rate/reference_rate);\n"
      "dD = dep/[D1 (P* + T*)^D2]; tension ends at T (1 - D) (a gap opens); dP = sqrt(P^2 + 2 beta K1 dU) - "
      "P "
      "with dU the\n"
      "shear energy lost by damage. Strength over 3/2 (HEL - P_HEL), pressures over P_HEL, rate that of the "
      "total strain.\n"
      "Source: Johnson and Holmquist, AIP Conf. Proc. 309 (1994) 981.";

  /// @throws InputError if the constants are inconsistent
  void require_consistent() const {
    if (!(hugoniot_elastic_limit > pressure_at_elastic_limit)) {
      throw InputError("'hugoniot_elastic_limit' must be above 'pressure_at_elastic_limit'");
    }
  }
  [[nodiscard]] double strength_at_elastic_limit() const {
    return 1.5 * (hugoniot_elastic_limit - pressure_at_elastic_limit);
  }
  [[nodiscard]] double least_pressure(const BrittlePoint& point) const {
    return -tensile_strength * (1.0 - point.damage);
  }
  static double crushed_strain(const BrittlePoint&) { return 0.0; }
  [[nodiscard]] BrittleSurface surface(const BrittlePoint& point) const {
    const double scale = strength_at_elastic_limit(), p = point.pressure / pressure_at_elastic_limit;
    const double over_tension = std::max(0.0, p + tensile_strength / pressure_at_elastic_limit);
    const double factor = logarithmic_rate_factor(rate_coefficient, point.rate, reference_rate);
    const double intact = intact_coefficient * std::pow(over_tension, intact_exponent) * factor;
    const double fractured = p > 0.0
                                 ? std::min(fractured_coefficient * std::pow(p, fractured_exponent) * factor,
                                            maximum_fractured_strength)
                                 : 0.0;
    return {scale * intact, scale * std::max(0.0, intact - fractured),
            std::numeric_limits<double>::infinity(),
            damage_coefficient * std::pow(over_tension, damage_exponent)};
  }
};

using JohnsonHolmquist2Model = BrittleModel<JohnsonHolmquist2>;

}  // namespace whipple::strength

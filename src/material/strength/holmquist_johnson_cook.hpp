// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/material/strength/brittle.hpp"

namespace whipple::strength {

/// Holmquist-Johnson-Cook, concrete. Stresses over the compressive strength f_c:
///   Y* = min([A (1 - D) + B P*^N] f, S_max),  P* > 0;   Y* = A (1 - D + P*/T*) f,  P* <= 0,
///   f = 1 + C ln max(1, rate/rate_0),  dD = (dep + dmu_p)/eps_f,  eps_f = max(D1 (P* + T*)^D2, EF_min),
///   P >= -T (1 - D), mu_p the compression at rest that crushed pores leave (of the equation of state
/// `holmquist_johnson_cook`). Source: T. J. Holmquist, G. R. Johnson, W. H. Cook, 14th Int. Symp. Ballistics,
/// Quebec (1993) 591-600. docs/theory/concrete_and_ceramics.md, section 3.
struct HolmquistJohnsonCook : ElasticConstants {
  double compressive_strength = 0.0;                                  ///< f_c, Pa
  double tensile_strength = 0.0;                                      ///< T, Pa
  double cohesion = 0.0;                                              ///< A
  double pressure_coefficient = 0.0;                                  ///< B
  double pressure_exponent = 0.0;                                     ///< N
  double maximum_strength = std::numeric_limits<double>::infinity();  ///< S_max, over f_c
  double rate_coefficient = 0.0;                                      ///< C
  double reference_rate = 1.0;                                        ///< 1/s
  double damage_coefficient = 0.0;                                    ///< D1
  double damage_exponent = 1.0;                                       ///< D2
  double least_failure_strain = 0.0;                                  ///< EF_min

  static ParameterTable<HolmquistJohnsonCook> parameters() {
    using P = HolmquistJohnsonCook;
    return ElasticConstants::parameters<P>(
        {real("compressive_strength", &P::compressive_strength, "Pa", range::positive(),
              "f_c, quasi-static, uniaxial"),
         real("tensile_strength", &P::tensile_strength, "Pa", range::positive(),
              "T: tensile strength of undamaged material, a pressure"),
         real("cohesion", &P::cohesion, "", range::non_negative(), "A, over f_c: the part lost by damage"),
         real("pressure_coefficient", &P::pressure_coefficient, "", range::non_negative(), "B"),
         real("pressure_exponent", &P::pressure_exponent, "", range::positive(), "N"),
         real("maximum_strength", &P::maximum_strength, "", range::positive(), "S_max, over f_c").optional(),
         real("rate_coefficient", &P::rate_coefficient, "", range::non_negative(), "C").optional(),
         real("reference_rate", &P::reference_rate, "1/s", range::positive(),
              "strain rate at and below which the rate factor is 1")
             .optional(),
         real("damage_coefficient", &P::damage_coefficient, "", range::non_negative(), "D1"),
         real("damage_exponent", &P::damage_exponent, "", range::non_negative(), "D2").optional(),
         real("least_failure_strain", &P::least_failure_strain, "", range::positive(),
              "EF_min: lower bound of the strain to failure")});
  }
  static constexpr const char* name = "holmquist_johnson_cook";
  static constexpr const char* summary =
      "concrete: pressure, damage and strain rate (Holmquist-Johnson-Cook)";
  static constexpr const char* theory =
      "Y* = min([A (1 - D) + B P*^N] f, S_max) in compression, A (1 - D + P*/T*) f in tension, f = 1 + C ln "
      "max(1, rate/reference_rate);\n"
      "dD = (dep + dmu_p)/max(D1 (P* + T*)^D2, EF_min), mu_p of crushed pores; tension ends at T (1 - D) (a "
      "gap "
      "opens).\n"
      "Stresses over f_c, rate that of the total strain; fully damaged material keeps B P*^N.\n"
      "Source: Holmquist, Johnson and Cook, 14th Int. Symp. Ballistics (1993) 591.";

  void require_consistent() const {}  // ensured by the ranges of the constants
  [[nodiscard]] double least_pressure(const BrittlePoint& point) const {
    return -tensile_strength * (1.0 - point.damage);
  }
  static double crushed_strain(const BrittlePoint& point) { return point.compaction; }
  [[nodiscard]] BrittleSurface surface(const BrittlePoint& point) const {
    const double p = point.pressure / compressive_strength, t = tensile_strength / compressive_strength;
    const double factor =
        compressive_strength * logarithmic_rate_factor(rate_coefficient, point.rate, reference_rate);
    const double strain =
        std::max(damage_coefficient * std::pow(std::max(0.0, p + t), damage_exponent), least_failure_strain);
    if (p <= 0.0) {
      const double whole = cohesion * (1.0 + p / t);
      return {factor * whole, factor * cohesion, compressive_strength * maximum_strength, strain};
    }
    return {factor * (cohesion + pressure_coefficient * std::pow(p, pressure_exponent)), factor * cohesion,
            compressive_strength * maximum_strength, strain};
  }
};

using HolmquistJohnsonCookModel = BrittleModel<HolmquistJohnsonCook>;

}  // namespace whipple::strength

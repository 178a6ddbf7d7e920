// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/failure/criterion.hpp"
#include "src/material/failure/void_growth_formulas.hpp"

namespace whipple::failure {

/// Ductile spall by rate-dependent growth of voids: with the distension alpha = alpha_0 + V_v/V of the material volume
/// V and the void volume V_v (m^3), and the mean pressure P = p/alpha on both (Pa, positive in compression),
///   d(alpha)/dt = -(alpha_0 - 1)^(2/3)/eta alpha (alpha - 1)^(1/3) (P + P_s)  where P < -P_s,
///   the same with P - P_s                                                      where P > +P_s,
///   P_s = a_s k (1 - f)/alpha ln(alpha/(alpha - 1)),
/// and zero in between. a_s is the resistance of the solid (2/3 of its yield stress in the static hollow sphere of
/// Carroll and Holt), eta a viscosity (Pa s), multiplied by 1 - f, alpha_0 - 1 the volume of the nuclei from which the
/// voids grow and to which they close (they have no stored void volume and no weight), f the melted fraction, k the
/// scatter of the threshold. The static spall strength is a_s ln(alpha_0/(alpha_0 - 1)), within a few parts in 1e4;
/// above it the tension that the growth cannot relax increases with the rate. Growth reduces the tension, not the
/// deviator of the material, which acts on the fraction V of the volume; compression closes the voids. Where the
/// porosity V_v/(V + V_v) reaches `failure_porosity` the voids have coalesced and the point fails (code 7); melted
/// material fails where p < 0 or with voids (code 1). With `healing` a failed point is intact again once pressure has
/// closed its void. The step is implicit in alpha and p at a fixed V + V_v. Source: J. N. Johnson, J. Appl. Phys. 52
/// (1981) 2812-2825; M. M. Carroll, A. C. Holt, J. Appl. Phys. 43 (1972) 1626. Nuclei separate from V_v and the factors
/// k and 1 - f are this project's choice.
struct ViscousVoidGrowth : Threshold {
  double resistance = 0.0;         ///< a_s, Pa
  double viscosity = 0.0;          ///< eta, Pa s
  double nuclei = 3e-4;            ///< alpha_0 - 1
  double failure_porosity = 0.15;  ///< Grady, J. Mech. Phys. Solids 36 (1988) 353: ductile spall
  bool healing = false;

  static ParameterTable<ViscousVoidGrowth> parameters() {
    using P = ViscousVoidGrowth;
    return {
        real("resistance", &P::resistance, "Pa", range::positive(),
             "a_s: static spall strength over ln(1 + 1/nuclei)"),
        real("viscosity", &P::viscosity, "Pa s", range::positive(), "eta, which slows the growth"),
        real("nuclei", &P::nuclei, "", range::open_between(0.0, 0.1),
             "alpha_0 - 1: volume of the nuclei over that of the solid")
            .optional(),
        real("failure_porosity", &P::failure_porosity, "", range::open_between(0.0, 1.0),
             "volume fraction of the voids at which the material parts")
            .optional(),
        boolean("healing", &P::healing, "points whose void pressure has closed are whole again").optional()};
  }
  static constexpr const char* name = "viscous_void_growth";
  static constexpr Code code = void_growth;
  static constexpr const char* cause = "growth of voids";
  static constexpr const char* summary = "spall: growth of voids at a rate (Johnson 1981)";
  static constexpr const char* theory =
      "d(alpha)/dt = -nuclei^(2/3)/viscosity alpha (alpha - 1)^(1/3) (P +- P_s) beyond P_s = "
      "resistance/alpha "
      "ln(alpha/(alpha - 1)),\n"
      "P = p/alpha, alpha = 1 + nuclei + void/material; resistance times (1 - melted fraction) * scatter "
      "factor. "
      "The deviator of the\n"
      "material stays, compression closes the voids; fails (code 7) at failure_porosity, melted material "
      "(code "
      "1) "
      "where p < 0.\n"
      "Source: Johnson, J. Appl. Phys. 52 (1981) 2812; Carroll and Holt, J. Appl. Phys. 43 (1972) 1626.";

  [[nodiscard]] Code healing_code() const { return healing ? void_growth : intact; }

  void grow_voids(const PorousState& state, std::span<double> /*damage*/,
                  std::span<std::uint8_t> failed) const {
    const double at_nuclei = formulas::tension_at_nuclei(nuclei);
    for (std::size_t i = 0; i < failed.size(); ++i) {
      const double solid = 1.0 - state.melted_fraction[i];
      const double strength = resistance * solid * state.threshold_factor[i];
      if (failed[i] != intact ||
          !formulas::may_grow(at_nuclei, strength, state.pressure[i], state.void_volume[i])) {
        continue;
      }
      failed[i] = formulas::grow_voids(*this, state.time_step, state.bulk_modulus[i], solid, strength,
                                       state.pressure[i], state.volume[i], state.void_volume[i]);
    }
  }
};

}  // namespace whipple::failure

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/material/failure/criterion.hpp"
#include "src/material/principal.hpp"

namespace whipple::failure {

/// Brittle fragmentation by the growth of Weibull flaws: n = k eps^m flaws per volume grow below the tensile
/// strain eps, each relieving the stress of a sphere around it that widens with the crack speed c_g. In the
/// explicit form,
///   d(D^(1/3))/dt = (m+3)/3 alpha^(1/3) eps^(m/3),  alpha = 8 pi c_g^3 k / ((m+1)(m+2)(m+3)),
/// with eps = sigma_1 / (K + 4/3 G), sigma_1 the largest principal stress of the material between the cracks,
/// and c_g a fraction of the longitudinal sound speed. No flaw grows below eps_0 = (k V)^(-1/m) times the
/// scatter of the threshold: at that strain the volume V of the point holds one flaw. Damage reduces
/// the stress as in docs/theory/material.md, eq. 18 and 19. Source: D. E. Grady, M. E. Kipp, Int. J. Rock Mech. Min.
/// Sci. 17 (1980) 147; explicit form: H. J. Melosh, E. V. Ryan, E. Asphaug, J. Geophys. Res. 97 (1992) 14735;
/// crack speed: B. R. Lawn, T. R. Wilshaw, Fracture of Brittle Solids (Cambridge 1975).
struct GradyKipp {
  static constexpr bool accumulates = true;
  static constexpr bool softens = true;
  static constexpr bool needs_strain = false;
  /// Damage that counts as complete: beyond it the strain cannot be computed from the remaining stiffness.
  static constexpr double complete = 0.999;

  double flaw_density = 0.0;       ///< k, 1/m^3
  double weibull_modulus = 0.0;    ///< m
  double crack_speed_ratio = 0.4;  ///< c_g over the longitudinal sound speed

  static ParameterTable<GradyKipp> parameters() {
    using P = GradyKipp;
    return {real("flaw_density", &P::flaw_density, "1/m^3", range::positive(),
                 "k: flaws per volume that are active below a strain of 1"),
            real("weibull_modulus", &P::weibull_modulus, "", range::positive(), "m of n = k eps^m"),
            real("crack_speed_ratio", &P::crack_speed_ratio, "", range::positive(),
                 "speed of the cracks over the longitudinal sound speed")
                .optional()};
  }
  static constexpr const char* name = "grady_kipp";
  static constexpr Code code = fragmented;
  static constexpr const char* cause = "fragmentation";
  static constexpr const char* summary =
      "brittle fragmentation: growth of Weibull flaws, damage that softens (Grady-Kipp)";
  static constexpr const char* theory =
      "d(D^(1/3))/dt = (m+3)/3 alpha^(1/3) eps^(m/3), alpha = 8 pi c_g^3 k/((m+1)(m+2)(m+3)),\n"
      "eps = sigma_1/(K + 4/3 G) of the material between the cracks, above (k V)^(-1/m) * scatter factor;\n"
      "tension and deviator are multiplied by 1 - D; failed (code 6) at D = 0.999.\n"
      "Source: Grady and Kipp, Int. J. Rock Mech. Min. Sci. 17 (1980) 147; Melosh, Ryan and Asphaug,\n"
      "J. Geophys. Res. 97 (1992) 14735.";
  void require_consistent() const {}  // ensured by the ranges of the constants

  /// Returns alpha^(1/3) / c_g, 1/m.
  [[nodiscard]] double growth() const {
    const double m = weibull_modulus;
    return std::cbrt(8.0 * std::numbers::pi * flaw_density / ((m + 1.0) * (m + 2.0) * (m + 3.0)));
  }
  void mark(const State& state, std::span<double> damage, std::span<std::uint8_t> failed) const {
    const double m = weibull_modulus;
    const double rate = (m + 3.0) / 3.0 * growth() * crack_speed_ratio;
    for (std::size_t i = 0; i < failed.size(); ++i) {
      if (failed[i] != intact) continue;
      const double whole = 1.0 - damage[i];
      const double p = state.pressure[i] < 0.0 ? state.pressure[i] / whole : state.pressure[i];
      const SymmetricTensor s = state.deviator[i];
      if (material::greatest_principal_bound(s) / whole <= p) continue;
      const double stress = material::greatest_principal_value(s) / whole - p;
      const double modulus = state.bulk_modulus[i] + 4.0 / 3.0 * state.shear_modulus[i];
      const double strain = stress / modulus;
      const double least = std::pow(flaw_density * state.volume[i], -1.0 / m) * state.threshold_factor[i];
      if (!(strain > least)) continue;
      const double speed = std::sqrt(modulus / state.density[i]);
      const double root = std::cbrt(damage[i]) + rate * speed * std::pow(strain, m / 3.0) * state.time_step;
      damage[i] = std::min(1.0, root * root * root);
      if (damage[i] < complete) continue;
      damage[i] = 1.0;
      failed[i] = fragmented;
    }
  }
};

}  // namespace whipple::failure

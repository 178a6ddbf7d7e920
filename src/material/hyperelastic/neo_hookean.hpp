// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/hyperelastic/response.hpp"

namespace whipple::material {

/// Compressible neo-Hookean solid (rubber): W = G/2 (I1 - 3). Source: J. Bonet, R. D. Wood, Nonlinear Continuum
/// Mechanics for Finite Element Analysis (Cambridge 2008), sec. 6.5.2.
struct NeoHookean {
  double shear_modulus = 0.0;  ///< G, Pa
  hyperelastic::Relaxation relaxation;

  static ParameterTable<NeoHookean> parameters() {
    return with_part({real("shear_modulus", &NeoHookean::shear_modulus, "Pa", range::positive(),
                           "shear modulus G of small strains")},
                     &NeoHookean::relaxation, hyperelastic::Relaxation::parameters());
  }
  static constexpr const char* name = "neo_hookean";
  static constexpr const char* summary = "neo-Hookean solid (rubber), may relax";
  static constexpr const char* theory =
      "W = G/2 (I1 - 3), I1 = tr b', b' = J^(-2/3) F F^T: s = G rho/rho0 dev b'.\n"
      "Source: Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis (2008), sec. 6.5.2.";

  void require_consistent() const {}
  [[nodiscard]] double shear() const { return shear_modulus; }
  [[nodiscard]] hyperelastic::Potential potential(double i1, double) const {
    return {0.5 * shear_modulus * (i1 - 3.0), 0.5 * shear_modulus, 0.0, 0.0};
  }
  [[nodiscard]] hyperelastic::Response respond(const hyperelastic::Tensor& b, double) const {
    return hyperelastic::response_of(*this, b);
  }
};

}  // namespace whipple::material

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/hyperelastic/response.hpp"

namespace whipple::material {

/// Blatz-Ko solid (foam rubber), whose shape and volume are coupled: W = G/2 (I2/I3 + 2 sqrt(I3) - 5) of b = F F^T.
/// With I2/I3 = J^(-2/3) I2' the part G/2 (3 J^(-2/3) + 2 J - 5) of a mere change of volume belongs to the equation of
/// state, a Murnaghan isentrope with K0 = 5/3 G and K0' = 5/3; the rest is W = G/2 J^(-2/3) (I2' - 3). Source: P. J.
/// Blatz, W. L. Ko, Trans. Soc. Rheol. 6 (1962) 223.
struct BlatzKo {
  double shear_modulus = 0.0;           ///< G, Pa
  hyperelastic::Relaxation relaxation;  ///< none: it has no parameters

  static ParameterTable<BlatzKo> parameters() {
    return {real("shear_modulus", &BlatzKo::shear_modulus, "Pa", range::positive(),
                 "shear modulus G of small strains")};
  }
  static constexpr const char* name = "blatz_ko";
  static constexpr const char* summary = "Blatz-Ko solid (foam rubber), whose shape and volume are coupled";
  static constexpr const char* theory =
      "W = G/2 J^(-2/3) (I2' - 3), I2' of b' = J^(-2/3) F F^T, J = rho0/rho: beside an equation of state\n"
      "\"murnaghan\" with bulk_modulus 5/3 G and bulk_modulus_slope 5/3 it is the solid of Blatz and Ko,\n"
      "G/2 (I2/I3 + 2 sqrt(I3) - 5), with Poisson's ratio 1/4.\n"
      "Source: P. J. Blatz and W. L. Ko, Trans. Soc. Rheol. 6 (1962) 223.";

  void require_consistent() const {}
  [[nodiscard]] double shear() const { return shear_modulus; }
  /// Computes the response: that of a potential of I2', W_2 = G/2 J^(-2/3), and the derivative of its factor by J.
  [[nodiscard]] hyperelastic::Response respond(const hyperelastic::Tensor& b, double ratio) const {
    const double factor = 1.0 / std::cbrt(ratio * ratio), half = 0.5 * shear_modulus * factor;
    const double i1 = b[0] + b[1] + b[2];
    const hyperelastic::Tensor square = hyperelastic::squared(b);
    const double i2 = 0.5 * (i1 * i1 - square[0] - square[1] - square[2]);
    hyperelastic::Response out;
    for (std::size_t j = 0; j < 6; ++j) out.stress[j] = 2.0 * half * (i1 * b[j] - square[j]);
    const double mean = (out.stress[0] + out.stress[1] + out.stress[2]) / 3.0;
    for (std::size_t j = 0; j < 3; ++j) out.stress[j] -= mean;
    out.energy = half * (i2 - 3.0);
    out.pressure = 2.0 / 3.0 * out.energy;
    // Of displacements a along waves of direction n: G [a.M a + 2 (a.n)(n.M a) - 5/3 J^(-2/3) (a.n)^2], M = b^-1 (29).
    const double spread = std::sqrt(std::max(i2 * i2 - 3.0 * i1, 0.0));
    const double largest = (i2 + 2.0 * spread) / 3.0;
    out.longitudinal = 2.0 * half * (3.0 * largest - 5.0 / 3.0);
    out.transverse = 2.0 * half * largest;
    out.coupling = 4.0 * half * spread / std::sqrt(3.0);
    return out;
  }
};

}  // namespace whipple::material

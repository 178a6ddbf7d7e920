// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/hyperelastic/response.hpp"

namespace whipple::material {

/// Yeoh's solid, which stiffens at large stretch: W = c1 x + c2 x^2 + c3 x^3, x = I1 - 3. Source: O. H. Yeoh, Rubber
/// Chem. Technol. 66 (1993) 754.
struct Yeoh {
  double c1 = 0.0;  ///< Pa
  double c2 = 0.0;  ///< Pa
  double c3 = 0.0;  ///< Pa
  hyperelastic::Relaxation relaxation;

  static ParameterTable<Yeoh> parameters() {
    return with_part({real("c1", &Yeoh::c1, "Pa", range::positive(), "half of the shear modulus"),
                      real("c2", &Yeoh::c2, "Pa", range::any(), "second coefficient, usually negative"),
                      real("c3", &Yeoh::c3, "Pa", range::non_negative(), "third coefficient")},
                     &Yeoh::relaxation, hyperelastic::Relaxation::parameters());
  }
  static constexpr const char* name = "yeoh";
  static constexpr const char* summary = "Yeoh's solid (rubber that stiffens), may relax";
  static constexpr const char* theory =
      "W = c1 x + c2 x^2 + c3 x^3, x = I1 - 3, I1 = tr b', b' = J^(-2/3) F F^T; G = 2 c1.\n"
      "dW/dI1 is positive at all stretches: c2 >= 0 or c2^2 < 3 c1 c3.\n"
      "Source: O. H. Yeoh, Rubber Chem. Technol. 66 (1993) 754.";

  /// @throws InputError if some stretch has no stiffness
  void require_consistent() const {
    if (c2 < 0.0 && !(c2 * c2 < 3.0 * c1 * c3)) {
      throw InputError("'c2' is so negative that dW/dI1 vanishes: it needs c2^2 < 3 c1 c3");
    }
  }
  [[nodiscard]] double shear() const { return 2.0 * c1; }
  [[nodiscard]] hyperelastic::Potential potential(double i1, double) const {
    const double x = i1 - 3.0;
    return {x * (c1 + x * (c2 + x * c3)), c1 + x * (2.0 * c2 + 3.0 * x * c3), 0.0, 2.0 * c2 + 6.0 * x * c3};
  }
  [[nodiscard]] hyperelastic::Response respond(const hyperelastic::Tensor& b, double) const {
    return hyperelastic::response_of(*this, b);
  }
};

}  // namespace whipple::material

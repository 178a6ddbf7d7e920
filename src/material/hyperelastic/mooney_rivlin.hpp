// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/hyperelastic/response.hpp"

namespace whipple::material {

/// Mooney-Rivlin solid: W = c1 (I1 - 3) + c2 (I2 - 3). Source: R. S. Rivlin, Phil. Trans. R. Soc. A 241 (1948) 379.
struct MooneyRivlin {
  double c1 = 0.0;  ///< Pa
  double c2 = 0.0;  ///< Pa
  hyperelastic::Relaxation relaxation;

  static ParameterTable<MooneyRivlin> parameters() {
    return with_part({real("c1", &MooneyRivlin::c1, "Pa", range::positive(), "dW/dI1"),
                      real("c2", &MooneyRivlin::c2, "Pa", range::non_negative(), "dW/dI2")},
                     &MooneyRivlin::relaxation, hyperelastic::Relaxation::parameters());
  }
  static constexpr const char* name = "mooney_rivlin";
  static constexpr const char* summary = "Mooney-Rivlin solid (rubber), may relax";
  static constexpr const char* theory =
      "W = c1 (I1 - 3) + c2 (I2 - 3), I1 = tr b', I2 = (I1^2 - b':b')/2, b' = J^(-2/3) F F^T; G = 2 (c1 + "
      "c2).\n"
      "Source: R. S. Rivlin, Phil. Trans. R. Soc. A 241 (1948) 379.";

  void require_consistent() const {}
  [[nodiscard]] double shear() const { return 2.0 * (c1 + c2); }
  [[nodiscard]] hyperelastic::Potential potential(double i1, double i2) const {
    return {c1 * (i1 - 3.0) + c2 * (i2 - 3.0), c1, c2, 0.0};
  }
  [[nodiscard]] hyperelastic::Response respond(const hyperelastic::Tensor& b, double) const {
    return hyperelastic::response_of(*this, b);
  }
};

}  // namespace whipple::material

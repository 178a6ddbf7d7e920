// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/section.hpp"

namespace whipple::cases {

/// Holds the coefficients of the artificial viscosity q (docs/theory/material.md, eq. 8).
struct ArtificialViscosity {
  double linear = 0.25;    ///< c1
  double quadratic = 1.0;  ///< c2
  double expansion = 0.0;  ///< c1 of expanding material

  static ParameterTable<ArtificialViscosity> parameters();
  /// Returns the coefficients of the case, which bodies inherit unless they specify others.
  static const ArtificialViscosity& inherited(const Case& setup);
};

}  // namespace whipple::cases

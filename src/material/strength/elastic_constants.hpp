// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::strength {

/// Holds the shear stiffness as published: the shear modulus, or Young's modulus and Poisson's ratio with G = E / (2 (1
/// + nu)). The equation of state alone determines the volumetric stiffness.
struct ElasticConstants {
  double shear_modulus = 0.0;   ///< Pa; 0: not given
  double youngs_modulus = 0.0;  ///< Pa; 0: not given
  double poisson_ratio = 0.0;

  /// Returns the table of a model that derives from this struct: these constants, then those of the model.
  template <class Owner>
  static ParameterTable<Owner> parameters(const ParameterTable<Owner>& own) {
    ParameterTable<Owner> table = {
        real<Owner>("shear_modulus", &Owner::shear_modulus, "Pa", range::non_negative(),
                    "shear modulus G (0: from Young's modulus and Poisson's ratio)")
            .optional(),
        real<Owner>("youngs_modulus", &Owner::youngs_modulus, "Pa", range::non_negative(),
                    "Young's modulus E (0: G is given)")
            .optional(),
        real<Owner>("poisson_ratio", &Owner::poisson_ratio, "",
                    Range{.lower = -1.0, .upper = 0.5, .lower_open = true}, "Poisson's ratio nu")
            .optional()};
    table.append(own);
    return table;
  }

  /// Returns the shear modulus, Pa.
  /// @throws InputError unless exactly one of G and E is positive
  [[nodiscard]] double stiffness() const {
    if ((shear_modulus > 0.0) == (youngs_modulus > 0.0)) {
      throw InputError(
          "needs a positive 'shear_modulus', or a positive 'youngs_modulus' with 'poisson_ratio', not both");
    }
    return shear_modulus > 0.0 ? shear_modulus : youngs_modulus / (2.0 * (1.0 + poisson_ratio));
  }
};

}  // namespace whipple::strength

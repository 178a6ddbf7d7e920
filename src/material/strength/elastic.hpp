// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/flow_law_model.hpp"
#include "src/material/strength/return_slopes.hpp"

namespace whipple::strength {

/// Isotropic elasticity without yield: the deviator follows the objective rate 2 G dev D. The equation of state
/// determines the volumetric stress.
struct Elastic : ElasticConstants {
  static ParameterTable<Elastic> parameters() { return ElasticConstants::parameters<Elastic>({}); }
  static constexpr const char* name = "elastic";
  static constexpr const char* summary = "linear elastic, no yield";
  static constexpr const char* theory =
      "ds/dt = 2 G dev D (objective); shear modulus G times the solid fraction.\n"
      "Source: Hughes and Winget, Int. J. Numer. Meth. Eng. 15 (1980) 1862 (integration of the rate).";

  void require_consistent() const {}
  [[nodiscard]] double flow_stress(double, double, double) const {
    return std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] double increment(double, double, double, double, double, double) const { return 0.0; }
  [[nodiscard]] ReturnSlopes slopes(const ReturnedPoint&) const { return {}; }
};

using ElasticModel = FlowLawModel<Elastic>;

}  // namespace whipple::strength

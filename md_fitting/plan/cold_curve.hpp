// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/core/base/parameter_table.hpp"

namespace whipple::md {

/// Requests energy and pressure of static crystals.
struct ColdCurvePlan {
  std::vector<double> volume_ratio;

  static ParameterTable<ColdCurvePlan> parameters();
};

}  // namespace whipple::md

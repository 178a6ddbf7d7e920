// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/core/base/parameter_table.hpp"

namespace whipple::md {

/// Requests elastic constants of the static crystal.
struct ElasticPlan {
  std::vector<double> volume_ratio = {1.0};
  double largest_strain = 0.005;
  std::int64_t strains = 5;

  static ParameterTable<ElasticPlan> parameters();
};

}  // namespace whipple::md

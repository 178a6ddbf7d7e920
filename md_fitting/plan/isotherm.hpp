// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/plan/target.hpp"

namespace whipple::md {

/// Requests states at one temperature and several volumes.
struct IsothermPlan {
  double temperature = 293.0;
  std::vector<double> volume_ratio;
  RunSize size{};
  Target target{};

  static ParameterTable<IsothermPlan> parameters();
};

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/plan/target.hpp"

namespace whipple::md {

/// Requests states at one volume and several temperatures.
struct IsochorePlan {
  double volume_ratio = 1.0;
  std::vector<double> temperature;
  RunSize size{};
  Target target{};

  static ParameterTable<IsochorePlan> parameters();
};

}  // namespace whipple::md

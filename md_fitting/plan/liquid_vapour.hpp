// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "src/core/input/faults.hpp"

namespace whipple::md {

struct Plan;

/// Requests a film of melt in equilibrium with its vapour.
struct LiquidVapourPlan {
  std::vector<double> temperature;
  double gap = 2.0;
  std::int64_t replicas = 4;
  RunSize size{.cells = 5, .equilibration_steps = 20000, .steps = 60000};

  static ParameterTable<LiquidVapourPlan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
};

}  // namespace whipple::md

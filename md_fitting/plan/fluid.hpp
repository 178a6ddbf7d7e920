// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/plan/target.hpp"
#include "src/core/input/faults.hpp"

namespace whipple::md {

struct Plan;

/// Requests states of the fluid at constant volume: hot liquid, supercritical and expanded fluid.
struct FluidPlan {
  std::vector<double> volume_ratio;
  std::vector<double> temperature;
  RunSize size{.cells = 4, .equilibration_steps = 3000, .steps = 8000};
  Target target{};

  static ParameterTable<FluidPlan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
};

}  // namespace whipple::md

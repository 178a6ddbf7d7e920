// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/plan/target.hpp"
#include "src/core/input/faults.hpp"

namespace whipple::md {

struct Plan;

/// Requests density and enthalpy of the melt.
struct LiquidPlan {
  std::vector<double> temperature;
  std::vector<double> pressure = {0.0};
  RunSize size{.cells = 6, .equilibration_steps = 4000, .steps = 15000};
  Target target{};

  static ParameterTable<LiquidPlan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
};

}  // namespace whipple::md

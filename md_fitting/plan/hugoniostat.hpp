// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "src/core/input/faults.hpp"

namespace whipple::md {

struct Plan;

/// Requests shocked states computed by the Hugoniostat.
struct HugoniostatPlan {
  std::vector<double> pressure;
  RunSize size{.cells = 5, .equilibration_steps = 5000, .steps = 20000};

  static ParameterTable<HugoniostatPlan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
};

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/plan/target.hpp"
#include "src/core/input/faults.hpp"

namespace whipple::md {

struct Plan;

/// Requests volume and energy at given temperatures and zero pressure; the first temperature is the reference of
/// the Hugoniot.
struct ZeroPressurePlan {
  std::vector<double> temperature = {293.0};
  RunSize size{.cells = 5, .equilibration_steps = 3000, .steps = 27000};
  Target target{};

  static ParameterTable<ZeroPressurePlan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
};

}  // namespace whipple::md

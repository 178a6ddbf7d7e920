// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/plan/target.hpp"
#include "src/core/input/faults.hpp"

namespace whipple::md {

struct Plan;

/// Requests shocked states starting from the first state at zero pressure.
struct HugoniotPlan {
  std::vector<double> volume_ratio;
  RunSize size{};
  Target target{};

  static ParameterTable<HugoniotPlan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
};

}  // namespace whipple::md

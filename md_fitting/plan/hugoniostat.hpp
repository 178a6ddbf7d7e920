// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "src/core/input/document.hpp"

namespace whipple::md {

struct Plan;

/// States behind a shock by the Hugoniostat.
struct HugoniostatPlan {
  std::vector<double> pressure;
  RunSize size{.cells = 5, .equilibration_steps = 5000, .steps = 20000};
};

std::vector<BoundParameter> keys(HugoniostatPlan& plan);
void check(const HugoniostatPlan& section, const Plan& plan, input::Table& table);

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/plan/target.hpp"
#include "src/core/input/document.hpp"

namespace whipple::md {

struct Plan;

/// States behind a shock from the first state at zero pressure.
struct HugoniotPlan {
  std::vector<double> volume_ratio;
  RunSize size{};
  Target target{};
};

std::vector<BoundParameter> keys(HugoniotPlan& plan);
void check(const HugoniotPlan& section, const Plan& plan, input::Table& table);

}  // namespace whipple::md

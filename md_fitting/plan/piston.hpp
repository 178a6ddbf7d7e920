// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "src/core/input/document.hpp"

namespace whipple::md {

struct Plan;

/// Shocks driven by a piston through a crystal.
struct PistonPlan {
  std::vector<double> particle_velocity;
  std::int64_t length = 60;  ///< unit cells along the shock
  RunSize size{.cells = 8, .equilibration_steps = 1000};
};

std::vector<BoundParameter> keys(PistonPlan& plan);
void check(const PistonPlan& section, const Plan& plan, input::Table& table);

}  // namespace whipple::md

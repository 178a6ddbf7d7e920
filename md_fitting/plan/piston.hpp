// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "src/core/input/faults.hpp"

namespace whipple::md {

struct Plan;

/// Requests shocks driven through a crystal by a piston.
struct PistonPlan {
  std::vector<double> particle_velocity;
  std::int64_t length = 60;  ///< unit cells along the shock
  RunSize size{.cells = 8, .equilibration_steps = 1000};

  static ParameterTable<PistonPlan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
};

}  // namespace whipple::md

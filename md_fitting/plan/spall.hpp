// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "src/core/input/faults.hpp"

namespace whipple::md {

struct Plan;

/// Requests the tensile strength of a crystal under triaxial stretching.
struct SpallPlan {
  std::vector<double> temperature = {293.0};
  double strain_rate = 1e10;
  std::int64_t replicas = 4;
  double largest_strain = 0.5;
  RunSize size{.cells = 6, .equilibration_steps = 2000};

  static ParameterTable<SpallPlan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
};

}  // namespace whipple::md

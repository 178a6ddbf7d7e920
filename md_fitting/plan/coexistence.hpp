// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/plan/target.hpp"
#include "src/core/input/faults.hpp"

namespace whipple::md {

struct Plan;

/// Requests melting temperatures by coexistence of crystal and melt.
struct CoexistencePlan {
  std::vector<double> pressure;
  std::vector<double> first_guess;  ///< K, one per pressure
  std::int64_t attempts = 4;
  std::int64_t replicas = 4;
  std::int64_t length = 20;  ///< unit cells along the normal of the interfaces
  RunSize size{.cells = 6, .equilibration_steps = 6000, .steps = 10000};
  Target target{};

  static ParameterTable<CoexistencePlan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
};

}  // namespace whipple::md

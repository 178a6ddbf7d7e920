// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/case/section.hpp"

namespace whipple::cases {

struct OutputControl {
  double snapshot_every = 0.0;      ///< s, simulated
  double checkpoint_every = 600.0;  ///< s, wall clock
  std::int64_t history_every = 1;   ///< steps
  std::int64_t gauges_every = 1;    ///< steps
  double maximum_energy_error = 0.01;
  std::vector<std::string> fields = default_fields();

  static std::vector<std::string> default_fields();
  static ParameterTable<OutputControl> parameters();
};

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "src/core/base/parameter_table.hpp"

namespace whipple::md {

/// Specifies the size and length of one simulation.
struct RunSize {
  std::int64_t cells = 5;  ///< unit cells along each edge
  std::int64_t equilibration_steps = 1500;
  std::int64_t steps = 6000;  ///< steps that are averaged
  double time_step = 0.0;     ///< s; 0: chosen by temperature, compression and mass

  static ParameterTable<RunSize> parameters();
};

}  // namespace whipple::md

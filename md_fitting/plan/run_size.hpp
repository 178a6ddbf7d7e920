// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/core/base/parameter_table.hpp"

namespace whipple::md {

/// Size and length of one simulation.
struct RunSize {
  std::int64_t cells = 5;  ///< unit cells along each edge
  std::int64_t equilibration_steps = 1500;
  std::int64_t steps = 6000;  ///< steps that are averaged
  double time_step = 0.0;     ///< s; 0: chosen by temperature, compression and mass
};

std::vector<BoundParameter> keys(RunSize& size);

/// The keys of a section, `own` first, then those of its run.
std::vector<BoundParameter> with_size(std::vector<BoundParameter> own, RunSize& size);

/// One list after another.
std::vector<BoundParameter> join_keys(std::vector<BoundParameter> first,
                                      const std::vector<BoundParameter>& second);

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/core/base/parameter_table.hpp"

namespace whipple::md {

/// How exactly the points of a section are wanted. No part of what a point is: a plan that asks for more
/// continues the points that a store holds.
struct Target {
  double error = 0.0;
  std::int64_t most_steps = 0;
};

/// @param unit    of the error; empty: relative
/// @param meaning which error is meant
std::vector<BoundParameter> keys(Target& target, const std::string& unit, const std::string& meaning);

}  // namespace whipple::md

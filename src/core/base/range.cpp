// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace whipple {

bool Range::contains(double value) const {
  const bool above = lower_open ? value > lower : value >= lower;
  const bool below = upper_open ? value < upper : value <= upper;
  return above && below;
}

std::string Range::text() const {
  std::string result;
  if (std::isfinite(lower)) result = fmt::format("{} {}", lower_open ? ">" : ">=", lower);
  if (std::isfinite(upper)) {
    if (!result.empty()) result += " and ";
    result += fmt::format("{} {}", upper_open ? "<" : "<=", upper);
  }
  return result.empty() ? "any" : result;
}

}  // namespace whipple

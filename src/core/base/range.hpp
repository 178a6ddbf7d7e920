// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>

namespace whipple {

/// Describes the admissible range of a number; infinite bounds mean no bound.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  [[nodiscard]] bool contains(double value) const;
  /// Returns "> 0", ">= 0 and < 0.5", "any".
  [[nodiscard]] std::string text() const;
};

namespace range {
inline Range any() { return {}; }
inline Range positive() { return {.lower = 0.0, .lower_open = true}; }
inline Range non_negative() { return {.lower = 0.0}; }
inline Range between(double lower, double upper) { return {.lower = lower, .upper = upper}; }
inline Range open_between(double lower, double upper) {
  return {.lower = lower, .upper = upper, .lower_open = true, .upper_open = true};
}
}  // namespace range

}  // namespace whipple

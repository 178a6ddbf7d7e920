// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/section.hpp"
#include "src/case/time_table.hpp"

namespace whipple::cases {

/// Describes the path of a tool: the factor over time of the velocities that a body has as prescribed, that of a driven
/// body and those of its node conditions (docs/theory/afemp.md, section 2).
struct Path {
  TimeTable table;

  static ParameterTable<Path> parameters();
  void check(const Case& setup, const Faults& faults) const;

  /// Returns the mean factor of a step from `time` (s) of the length `step` (s): with it the end of the step lies on the
  /// path exactly.
  [[nodiscard]] double factor(double time, double step) const { return table.mean(time, step); }
  /// Returns the greatest magnitude of the factor.
  [[nodiscard]] double largest() const;
};

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/section.hpp"
#include "src/case/time_table.hpp"

namespace whipple::cases {

/// Describes local damping: a part of the force on each node acts against its motion (docs/theory/mpm.md, equation
/// 3.5e).
struct Damping {
  double coefficient = 0.0;  ///< alpha; 0: none
  TimeTable table;

  static ParameterTable<Damping> parameters();
  void check(const Case& setup, const Faults& faults) const;

  /// Returns the mean coefficient over the step from `time` (s) of the length `step` (s).
  [[nodiscard]] double mean(double time, double step) const {
    return coefficient > 0.0 ? coefficient * table.mean(time, step) : 0.0;
  }
};

}  // namespace whipple::cases

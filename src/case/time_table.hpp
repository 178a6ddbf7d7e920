// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/case/section.hpp"

namespace whipple::cases {

/// Describes the factor of a load over time: linear between the entries, constant before the first and after the last.
struct TimeTable {
  std::vector<double> times = {0.0};    ///< s, increasing
  std::vector<double> factors = {1.0};  ///< one per time

  static ParameterTable<TimeTable> parameters();
  /// Adds a fault for a table that is empty, incomplete or not in the order of time.
  void check(const Faults& faults) const;

  /// Returns whether it is the one of a load without a table: a factor of 1 at all times.
  [[nodiscard]] bool is_default() const { return *this == TimeTable{}; }
  bool operator==(const TimeTable&) const = default;

  /// Returns the factor at a time (s).
  [[nodiscard]] double at(double time) const;
  /// Returns the exact mean of the factor over the step from `time` (s) of the length `step` (s) > 0.
  [[nodiscard]] double mean(double time, double step) const;
  /// Returns a bound of the integral of the magnitude of the factor from 0 to a time (s), exact where it keeps its sign.
  [[nodiscard]] double magnitude(double time) const;
  /// Returns the first time (s), not before the given one, from which the factor is not zero; infinite if there is none.
  [[nodiscard]] double next_event(double time) const;

 private:
  [[nodiscard]] double integral(double from, double to) const;
};

}  // namespace whipple::cases

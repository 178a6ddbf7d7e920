// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/section.hpp"
#include "src/case/time_table.hpp"
#include "src/core/base/tensor.hpp"

namespace whipple::cases {

struct Gravity {
  Vector3 acceleration = Vector3::Zero();  ///< m/s^2
  double rise_time = 0.0;                  ///< s
  TimeTable table;

  static ParameterTable<Gravity> parameters();
  void check(const Case& setup, const Faults& faults) const;

  /// Returns the factor of the acceleration over time: with `rise_time` linear from 0 at the start.
  [[nodiscard]] TimeTable factor() const {
    return rise_time > 0.0 ? TimeTable{{0.0, rise_time}, {0.0, 1.0}} : table;
  }
  /// Returns the acceleration at a time, m/s^2.
  [[nodiscard]] Vector3 at(double time) const { return factor().at(time) * acceleration; }
};

}  // namespace whipple::cases

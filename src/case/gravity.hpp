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

  /// Returns the acceleration at a time (s); it increases linearly from 0 up to `rise_time`.
  [[nodiscard]] Vector3 at(double time) const {
    return rise_time > time ? Vector3(time / rise_time * acceleration)
                            : Vector3(table.at(time) * acceleration);
  }
};

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/section.hpp"

namespace whipple::cases {

struct HeatControl {
  bool conduction = false;

  static ParameterTable<HeatControl> parameters();
  /// Adds faults if transfer or materials do not support conduction.
  void check(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases

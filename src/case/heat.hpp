// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/section.hpp"

namespace whipple::cases {

struct HeatControl {
  bool conduction = false;

  static ParameterTable<HeatControl> parameters();
  /// Adds what conduction needs of the transfer and of the materials.
  void check(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases

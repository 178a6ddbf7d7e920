// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "src/case/section.hpp"

namespace whipple::cases {

/// Particle splitting; no division at length 0.
struct Splitting {
  double length = 0.0;  ///< of a particle along its longest direction, in cells
  std::int64_t maximum_generations = 3;

  static ParameterTable<Splitting> parameters();
  void check(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases

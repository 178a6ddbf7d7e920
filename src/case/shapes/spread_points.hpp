// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "src/core/base/tensor.hpp"

namespace whipple::cases {

/// Returns a point of the unit cube, of a sequence that fills it evenly: an additive recurrence whose constants are
/// powers of 1/g, where g is the root of x^4 = x + 1.
inline Vector3 spread_point(std::size_t number) {
  constexpr double g = 1.2207440846057596;
  const Vector3 step(1.0 / g, 1.0 / (g * g), 1.0 / (g * g * g));
  Vector3 part = Vector3::Constant(0.5) + static_cast<double>(number) * step;
  for (double& x : part) x -= std::floor(x);
  return part;
}

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "src/core/base/tensor.hpp"
#include "src/core/base/vector_math.hpp"

namespace whipple::transfer {

/// The columns of s + mean I (Pa), in three lanes from `first_lane` on; the other one is some component.
template <int first_lane>
[[gnu::always_inline]] inline std::array<Lanes, 3> stress_columns(const SymmetricTensor& s, double mean) {
  static_assert(offsetof(SymmetricTensor, zx) == 5 * sizeof(double));
  const double* const components = &s.xx;
  const Lanes front = load(components) + mean * Lanes{1.0, 1.0, 1.0, 0.0},  // xx, yy, zz, xy
      back = load(components + 2) + mean * Lanes{1.0, 0.0, 0.0, 0.0};       // zz, xy, yz, zx
  if constexpr (first_lane == 0) {
    return {__builtin_shufflevector(front, back, 0, 5, 7, 3),
            __builtin_shufflevector(front, back, 5, 1, 6, 3),
            __builtin_shufflevector(front, back, 7, 6, 4, 3)};
  } else {
    static_assert(first_lane == 1);
    return {__builtin_shufflevector(front, back, 0, 0, 5, 7),
            __builtin_shufflevector(front, back, 0, 5, 1, 6),
            __builtin_shufflevector(front, back, 0, 7, 6, 4)};
  }
}

}  // namespace whipple::transfer

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "src/core/base/simd.hpp"

/// Software prefetching. Hardware prefetchers are effective if few arrays are read in long sequences. Sweeps over
/// points read about twenty arrays, some dozens of values of each in turn, and therefore prefetch explicitly.
namespace whipple {

constexpr std::size_t prefetched_together = 8;
/// Sets the prefetch distance in points that gives a sweep over a few arrays enough time.
constexpr std::size_t prefetch_distance = 32;

/// Returns whether a point is due to prefetch the values of itself and the following points.
WHIPPLE_INLINE inline bool prefetches(std::size_t point) { return point % prefetched_together == 0; }

/// Prefetches the values of `prefetched_together` points from `first` on into the second-level cache. They may be
/// beyond the end of the arrays.
template <class... Array>
WHIPPLE_INLINE inline void prefetch(std::size_t first, const Array&... arrays) {
  const auto values_of = [first](const auto& array) WHIPPLE_INLINE {
    constexpr std::size_t line = 64;  // bytes
    constexpr std::size_t value = sizeof(array[0]);
    const auto* from = reinterpret_cast<const std::byte*>(array.data()) + first * value;
    for (std::size_t b = 0; b < prefetched_together * value; b += line) __builtin_prefetch(from + b, 0, 2);
  };
  (values_of(arrays), ...);
  asm volatile("");  // prevents the compiler from removing calls of functions without other effects
}

}  // namespace whipple

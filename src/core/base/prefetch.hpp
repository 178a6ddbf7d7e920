// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "src/core/base/simd.hpp"

/// The processor foresees which memory is read next as long as few arrays are read and each for long. Sweeps
/// over points read a score of arrays, some dozens of values of each in turn: they ask for their values
/// themselves.
namespace whipple {

constexpr std::size_t prefetched_together = 8;
/// Points on the way to which a sweep over a few arrays has time to have them fetched.
constexpr std::size_t prefetch_distance = 32;

/// Returns whether it is the turn of a point to fetch the values of itself and the next ones.
WHIPPLE_INLINE inline bool prefetches(std::size_t point) { return point % prefetched_together == 0; }

/// Fetches the values of `prefetched_together` points from `first` on into the second-level cache. They
/// may lie behind the end.
template <class... Array>
WHIPPLE_INLINE inline void prefetch(std::size_t first, const Array&... arrays) {
  const auto values_of = [first](const auto& array) WHIPPLE_INLINE {
    constexpr std::size_t line = 64;  // bytes
    constexpr std::size_t value = sizeof(array[0]);
    const auto* from = reinterpret_cast<const std::byte*>(array.data()) + first * value;
    for (std::size_t b = 0; b < prefetched_together * value; b += line) __builtin_prefetch(from + b, 0, 2);
  };
  (values_of(arrays), ...);
  asm volatile("");  // else the compiler sees functions around it that do nothing, and drops their calls
}

}  // namespace whipple

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

/// The register of four doubles and its companions: vector extensions of the compiler, for any processor.
namespace whipple {

/// Holds four doubles.
using Lanes [[gnu::vector_size(32)]] = double;
/// Holds the result of a comparison of Lanes; `mask ? a : b` selects lane by lane.
using LanesMask = decltype(Lanes{} < Lanes{});
/// Holds four whole numbers, and two doubles.
using Indices [[gnu::vector_size(16)]] = std::int32_t;
using Pair [[gnu::vector_size(16)]] = double;

inline Lanes broadcast(double value) { return Lanes{value, value, value, value}; }
/// Loads (stores) unaligned numbers.
inline Pair load_pair(const double* from) {
  using Unaligned [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;
  return Pair(*reinterpret_cast<const Unaligned*>(from));
}
inline void store(double* to, Pair x) {
  using Unaligned [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;
  *reinterpret_cast<Unaligned*>(to) = x;
}
inline void store(std::int32_t* to, Indices x) {
  using Unaligned [[gnu::vector_size(16), gnu::aligned(4), gnu::may_alias]] = std::int32_t;
  *reinterpret_cast<Unaligned*>(to) = x;
}

}  // namespace whipple

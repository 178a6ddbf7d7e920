// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// Random numbers that depend only on a seed and a number, wherever they are computed.
namespace whipple {

/// Distributes a number evenly over 64 bits: a step and the finaliser of SplitMix64 (Steele, Lea and Flood, OOPSLA
/// 2014).
/// @param steps  of its counter
[[nodiscard]] constexpr std::uint64_t scattered(std::uint64_t x, std::uint64_t steps = 1) {
  x += 0x9e3779b97f4a7c15U * steps;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

/// Returns bits that depend on all bits of both arguments.
[[nodiscard]] constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t number) {
  return scattered(scattered(seed), number + 1);
}

/// Returns a number in (0, 1].
[[nodiscard]] constexpr double uniform(std::uint64_t seed, std::uint64_t number) {
  return static_cast<double>((random_bits(seed, number) >> 11U) + 1) * 0x1p-53;
}

}  // namespace whipple

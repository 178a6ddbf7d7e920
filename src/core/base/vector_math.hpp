// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "src/core/base/registers.hpp"

/// Elementary functions of four doubles, by the vector mathematics library of glibc (libmvec, AVX2 variant; maximum
/// error 4 ulp), without AVX2 one by one. For batch loops; a single point and a batch of points must use the same function to agree bitwise.
namespace whipple {

#ifndef __CUDACC__
#if WHIPPLE_AVX2
namespace libmvec {
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): names of the library
[[gnu::const]] __m256d _ZGVdN4v_exp(__m256d);
[[gnu::const]] __m256d _ZGVdN4v_expm1(__m256d);
[[gnu::const]] __m256d _ZGVdN4v_log(__m256d);
[[gnu::const]] __m256d _ZGVdN4vv_pow(__m256d, __m256d);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
}
}  // namespace libmvec

inline Lanes exp(Lanes x) { return Lanes(libmvec::_ZGVdN4v_exp(__m256d(x))); }
/// Returns exp(x) - 1.
inline Lanes exp_minus_1(Lanes x) { return Lanes(libmvec::_ZGVdN4v_expm1(__m256d(x))); }
/// Returns the natural logarithm; `log` is the namespace of the messages (src/core/base/log.hpp).
inline Lanes natural_log(Lanes x) { return Lanes(libmvec::_ZGVdN4v_log(__m256d(x))); }
inline Lanes pow(Lanes x, Lanes y) { return Lanes(libmvec::_ZGVdN4vv_pow(__m256d(x), __m256d(y))); }
#else
inline Lanes exp(Lanes x) {
  return by_lane([&](std::size_t l) { return std::exp(x[l]); });
}
/// Returns exp(x) - 1.
inline Lanes exp_minus_1(Lanes x) {
  return by_lane([&](std::size_t l) { return std::expm1(x[l]); });
}
/// Returns the natural logarithm; `log` is the namespace of the messages (src/core/base/log.hpp).
inline Lanes natural_log(Lanes x) {
  return by_lane([&](std::size_t l) { return std::log(x[l]); });
}
inline Lanes pow(Lanes x, Lanes y) {
  return by_lane([&](std::size_t l) { return std::pow(x[l], y[l]); });
}
#endif
inline Lanes exponential(Lanes x) { return exp(x); }
#endif
/// Returns the natural logarithm of positive normal numbers to 4e-8, for initial guesses, at a third of the cost. Loops
/// over it are vectorised by the compiler.
WHIPPLE_POINT inline double rough_log(double x) {
  // x = 2^k m with m from sqrt(1/2) to sqrt(2)
  constexpr std::uint64_t least = 0x3fe6a09e667f3bcd, exponent = ~0xfffffffffffffULL,
                          one = 0x4330000000000000;
  const auto bits = std::bit_cast<std::uint64_t>(x), from_least = bits - least;
  const auto m = std::bit_cast<double>(bits - (from_least & exponent));
  // k in [-2048, 2047] as the last bits of 2^52 + 2048 + k
  const double whole =
      std::bit_cast<double>(((from_least >> 52) ^ 2048) | one) - (4503599627370496.0 + 2048.0);
  const double s = (m - 1.0) / (m + 1.0), square = s * s;  // ln m = 2 artanh s
  return 0.6931471805599453 * whole +
         s * (2.0 + square * (2.0 / 3.0 + square * (2.0 / 5.0 + square * (2.0 / 7.0))));
}

/// Applies the function to whole arrays in place, eight numbers at a time if the processor supports it (errors as
/// above; results may differ in the last bits). @param size a multiple of 8
void exponentials(double* x, std::size_t size);
void logarithms(double* x, std::size_t size);

}  // namespace whipple

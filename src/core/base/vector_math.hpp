// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "src/core/base/simd.hpp"

/// Elementary functions of four doubles, by the vector mathematics library of glibc (libmvec, AVX2 variant; maximum
/// error 4 ulp). For batch loops; a single point and a batch of points must use the same function to agree bitwise.
namespace whipple {

namespace libmvec {
extern "C" {
[[gnu::const]] __m256d _ZGVdN4v_exp(__m256d);
[[gnu::const]] __m256d _ZGVdN4v_expm1(__m256d);
[[gnu::const]] __m256d _ZGVdN4v_log(__m256d);
[[gnu::const]] __m256d _ZGVdN4vv_pow(__m256d, __m256d);
}
}  // namespace libmvec

inline Lanes exp(Lanes x) { return Lanes(libmvec::_ZGVdN4v_exp(__m256d(x))); }
/// Returns exp(x) - 1.
inline Lanes exp_minus_1(Lanes x) { return Lanes(libmvec::_ZGVdN4v_expm1(__m256d(x))); }
/// Returns the natural logarithm; `log` is the namespace of the messages (src/core/base/log.hpp).
inline Lanes natural_log(Lanes x) { return Lanes(libmvec::_ZGVdN4v_log(__m256d(x))); }
/// Returns the natural logarithm of positive normal numbers to 4e-8, for initial guesses, at a third of the cost. Loops
/// over it are vectorised by the compiler.
inline double rough_log(double x) {
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
inline Lanes pow(Lanes x, Lanes y) { return Lanes(libmvec::_ZGVdN4vv_pow(__m256d(x), __m256d(y))); }
inline Lanes sqrt(Lanes x) { return Lanes(_mm256_sqrt_pd(__m256d(x))); }
/// Returns the smaller (larger) value per lane; b if one is NaN.
inline Lanes minimum(Lanes a, Lanes b) { return Lanes(_mm256_min_pd(__m256d(a), __m256d(b))); }
inline Lanes maximum(Lanes a, Lanes b) { return Lanes(_mm256_max_pd(__m256d(a), __m256d(b))); }
inline Lanes floor(Lanes x) { return Lanes(_mm256_floor_pd(__m256d(x))); }
/// Returns a b + c, rounded once: used explicitly where two implementations must agree bitwise.
inline Lanes multiply_add(Lanes a, Lanes b, Lanes c) {
  return Lanes(_mm256_fmadd_pd(__m256d(a), __m256d(b), __m256d(c)));
}
inline Lanes absolute(Lanes x) { return Lanes(_mm256_andnot_pd(_mm256_set1_pd(-0.0), __m256d(x))); }
/// Loads (stores) four unaligned numbers.
inline Lanes load(const double* from) { return Lanes(_mm256_loadu_pd(from)); }
inline void store(double* to, Lanes x) { _mm256_storeu_pd(to, __m256d(x)); }
/// Loads (stores) three numbers in lanes 0 to 2; lane 3 is 0.
inline Lanes load_vector(const double* from) {
  return Lanes(_mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(from)), _mm_load_sd(from + 2), 1));
}
/// Returns lanes 0 to 2, rounded down.
inline std::array<int, 3> floor_of_three(Lanes x) {
  const __m128i down = _mm256_cvttpd_epi32(__m256d(floor(x)));
  return {_mm_extract_epi32(down, 0), _mm_extract_epi32(down, 1), _mm_extract_epi32(down, 2)};
}
inline void store_vector(double* to, Lanes x) {
  _mm_storeu_pd(to, _mm256_castpd256_pd128(__m256d(x)));
  _mm_store_sd(to + 2, _mm256_extractf128_pd(__m256d(x), 1));
}
/// Loads one number into all lanes.
inline Lanes broadcast_from(const double* from) { return Lanes(_mm256_broadcast_sd(from)); }
/// Loads (stores) the first `count` numbers; the other lanes are set to `rest`.
inline Lanes load(const double* from, std::size_t count, double rest) {
  if (count >= 4) return load(from);
  Lanes x = broadcast(rest);
  for (std::size_t i = 0; i < count; ++i) x[i] = from[i];
  return x;
}
inline void store(double* to, Lanes x, std::size_t count) {
  if (count >= 4) return store(to, x);
  for (std::size_t i = 0; i < count; ++i) to[i] = x[i];
}

/// Transposes rows to columns.
inline std::array<Lanes, 4> transposed(const std::array<Lanes, 4>& rows) {
  const __m256d r0 = __m256d(rows[0]), r1 = __m256d(rows[1]), r2 = __m256d(rows[2]), r3 = __m256d(rows[3]);
  const __m256d a = _mm256_unpacklo_pd(r0, r1), b = _mm256_unpackhi_pd(r0, r1);
  const __m256d c = _mm256_unpacklo_pd(r2, r3), d = _mm256_unpackhi_pd(r2, r3);
  return {Lanes(_mm256_permute2f128_pd(a, c, 0x20)), Lanes(_mm256_permute2f128_pd(b, d, 0x20)),
          Lanes(_mm256_permute2f128_pd(a, c, 0x31)), Lanes(_mm256_permute2f128_pd(b, d, 0x31))};
}

/// Holds four consecutive 3-vectors by component.
struct FourVectors {
  Lanes x, y, z;
};
inline FourVectors load_four_vectors(const double* from) {
  const Lanes a = load(from), b = load(from + 4), c = load(from + 8);  // x y z x, y z x y, z x y z
  const Lanes ab_x = __builtin_shufflevector(a, b, 0, 3, 6, 6),
              ab_y = __builtin_shufflevector(a, b, 1, 4, 7, 7),
              ab_z = __builtin_shufflevector(a, b, 2, 5, 5, 5);
  return {__builtin_shufflevector(ab_x, c, 0, 1, 2, 5), __builtin_shufflevector(ab_y, c, 0, 1, 2, 6),
          __builtin_shufflevector(ab_z, c, 0, 1, 4, 7)};
}
/// Replicates one number per vector to the twelve components of four vectors, in their order.
inline std::array<Lanes, 3> beside_components(Lanes four) {
  return {__builtin_shufflevector(four, four, 0, 0, 0, 1), __builtin_shufflevector(four, four, 1, 1, 2, 2),
          __builtin_shufflevector(four, four, 2, 3, 3, 3)};
}

/// Applies the function to whole arrays in place, eight numbers at a time if the processor supports it (errors as
/// above; results may differ in the last bits). @param size a multiple of 8
void exponentials(double* x, std::size_t size);
void logarithms(double* x, std::size_t size);

/// Holds the result of a comparison of Lanes; `mask ? a : b` selects lane by lane.
using LanesMask = decltype(Lanes{} < Lanes{});
/// Returns one bit per lane of a comparison.
inline unsigned bits(LanesMask mask) { return static_cast<unsigned>(_mm256_movemask_pd(__m256d(mask))); }
inline constexpr unsigned all_lanes = 15;
inline bool any(LanesMask mask) { return bits(mask) != 0; }
inline Lanes select(LanesMask mask, Lanes a, Lanes b) { return mask ? a : b; }

/// Selects a in lanes where the sign of x is negative, else b, without a comparison.
inline Lanes select_negative(Lanes x, Lanes a, Lanes b) {
  return Lanes(_mm256_blendv_pd(__m256d(b), __m256d(a), __m256d(x)));
}

// Scalar versions, for formulas written for either type.
inline double natural_log(double x) { return std::log(x); }
inline double minimum(double a, double b) { return std::min(a, b); }
inline double maximum(double a, double b) { return std::max(a, b); }
inline bool any(bool mask) { return mask; }
inline double select(bool mask, double a, double b) { return mask ? a : b; }

}  // namespace whipple

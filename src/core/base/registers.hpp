// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "src/core/base/simd.hpp"
#include "src/core/base/triple.hpp"

/// Numbers that are processed together, under the same names for each width: one `double`, the four of an AVX2 register
/// (Lanes), the eight of an AVX-512 register (WideLanes). A kernel is a template on the register and is entered through
/// `Narrow::run` or `Wide::run`, which is compiled for the processor and inlines all that the kernel calls. Functions
/// with instructions of AVX-512 carry that target and are `inline` only: the compiler then leaves them as calls in
/// templates, which have no target of their own, and inlines them in `Wide::run`; forced inlining would be an error.
namespace whipple {

/// Counts the numbers of a register.
template <class Register>
constexpr std::size_t width = sizeof(Register) / sizeof(double);  // NOLINT(bugprone-sizeof-expression)

// A number.
WHIPPLE_POINT inline double multiply_add(double a, double b, double c) { return std::fma(a, b, c); }
/// Returns the smaller (larger) number as the instruction does: b if one is NaN.
WHIPPLE_POINT inline double minimum(double a, double b) { return a < b ? a : b; }
WHIPPLE_POINT inline double maximum(double a, double b) { return a > b ? a : b; }
inline bool any(bool mask) { return mask; }
inline bool all_positive(double x) { return x > 0.0; }
WHIPPLE_POINT inline double select(bool mask, double a, double b) { return mask ? a : b; }
/// Returns the logarithm (exponential) of a number, for formulas written for any width.
WHIPPLE_POINT inline double natural_log(double x) { return std::log(x); }
WHIPPLE_POINT inline double exponential(double x) { return std::exp(x); }

#ifndef __CUDACC__  // kernels of a graphics processor take single numbers
/// Holds four doubles: vector extension of the compiler.
using Lanes [[gnu::vector_size(32)]] = double;
/// Holds the result of a comparison of Lanes; `mask ? a : b` selects lane by lane.
using LanesMask = decltype(Lanes{} < Lanes{});

inline Lanes broadcast(double value) { return Lanes{value, value, value, value}; }
/// Loads one number into all lanes.
inline Lanes broadcast_from(const double* from) { return Lanes(_mm256_broadcast_sd(from)); }
/// Loads (stores) four unaligned numbers.
inline Lanes load(const double* from) { return Lanes(_mm256_loadu_pd(from)); }
inline void store(double* to, Lanes x) { _mm256_storeu_pd(to, __m256d(x)); }
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
/// Loads (stores) three numbers in lanes 0 to 2; lane 3 is 0.
inline Lanes load_vector(const double* from) {
  return Lanes(_mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(from)), _mm_load_sd(from + 2), 1));
}
inline void store_vector(double* to, Lanes x) {
  _mm_storeu_pd(to, _mm256_castpd256_pd128(__m256d(x)));
  _mm_store_sd(to + 2, _mm256_extractf128_pd(__m256d(x), 1));
}

/// Returns the sum of the first three lanes.
inline double sum3(Lanes v) { return v[0] + v[1] + v[2]; }
inline double sum4(Lanes v) { return v[0] + v[1] + v[2] + v[3]; }

/// Returns a b + c, rounded once: used explicitly where two implementations must agree bitwise.
inline Lanes multiply_add(Lanes a, Lanes b, Lanes c) {
  return Lanes(_mm256_fmadd_pd(__m256d(a), __m256d(b), __m256d(c)));
}
inline Lanes sqrt(Lanes x) { return Lanes(_mm256_sqrt_pd(__m256d(x))); }
/// Returns the smaller (larger) value per lane; b if one is NaN.
inline Lanes minimum(Lanes a, Lanes b) { return Lanes(_mm256_min_pd(__m256d(a), __m256d(b))); }
inline Lanes maximum(Lanes a, Lanes b) { return Lanes(_mm256_max_pd(__m256d(a), __m256d(b))); }
inline Lanes floor(Lanes x) { return Lanes(_mm256_floor_pd(__m256d(x))); }
inline Lanes absolute(Lanes x) { return Lanes(_mm256_andnot_pd(_mm256_set1_pd(-0.0), __m256d(x))); }
/// Returns lanes 0 to 2, rounded down.
inline std::array<int, 3> floor_of_three(Lanes x) {
  const __m128i down = _mm256_cvttpd_epi32(__m256d(floor(x)));
  return {_mm_extract_epi32(down, 0), _mm_extract_epi32(down, 1), _mm_extract_epi32(down, 2)};
}
/// Returns one bit per lane of a comparison.
inline unsigned bits(LanesMask mask) { return static_cast<unsigned>(_mm256_movemask_pd(__m256d(mask))); }
inline constexpr unsigned all_lanes = 15;
inline bool any(LanesMask mask) { return bits(mask) != 0; }
inline bool all_positive(Lanes x) { return bits(x > 0.0) == all_lanes; }
inline Lanes select(LanesMask mask, Lanes a, Lanes b) { return mask ? a : b; }
/// Selects a in lanes where the sign of x is negative, else b, without a comparison.
inline Lanes select_negative(Lanes x, Lanes a, Lanes b) {
  return Lanes(_mm256_blendv_pd(__m256d(b), __m256d(a), __m256d(x)));
}
/// Returns x with lanes from `count` on set to zero.
inline Lanes first_lanes(Lanes x, std::size_t count) {
  for (std::size_t l = count; l < 4; ++l) x[l] = 0.0;
  return x;
}
/// Transposes rows to columns.
inline std::array<Lanes, 4> transposed(const std::array<Lanes, 4>& rows) {
  const auto r0 = __m256d(rows[0]), r1 = __m256d(rows[1]), r2 = __m256d(rows[2]), r3 = __m256d(rows[3]);
  const __m256d a = _mm256_unpacklo_pd(r0, r1), b = _mm256_unpackhi_pd(r0, r1);
  const __m256d c = _mm256_unpacklo_pd(r2, r3), d = _mm256_unpackhi_pd(r2, r3);
  return {Lanes(_mm256_permute2f128_pd(a, c, 0x20)), Lanes(_mm256_permute2f128_pd(b, d, 0x20)),
          Lanes(_mm256_permute2f128_pd(a, c, 0x31)), Lanes(_mm256_permute2f128_pd(b, d, 0x31))};
}
/// Loads four consecutive 3-vectors, by component.
inline Triple<Lanes> load_vectors(const double* from) {
  const Lanes a = load(from), b = load(from + 4), c = load(from + 8);  // x y z x, y z x y, z x y z
  const Lanes ab_x = __builtin_shufflevector(a, b, 0, 3, 6, 6),
              ab_y = __builtin_shufflevector(a, b, 1, 4, 7, 7),
              ab_z = __builtin_shufflevector(a, b, 2, 5, 5, 5);
  return {__builtin_shufflevector(ab_x, c, 0, 1, 2, 5), __builtin_shufflevector(ab_y, c, 0, 1, 2, 6),
          __builtin_shufflevector(ab_z, c, 0, 1, 4, 7)};
}

// A register whose lanes 0 to 2 are a vector.
/// Returns lane a in all lanes.
inline Lanes lane(Lanes v, std::size_t a) { return broadcast(v[a]); }
/// Returns lanes 1, 2, 0, 3.
inline Lanes cycled(Lanes v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); }

/// Registers of AVX2, and how kernels for them are entered.
struct Narrow {
  using Register = Lanes;
  template <class Kernel>
  WHIPPLE_WHOLE_KERNEL static decltype(auto) run(const Kernel& kernel) {
    return kernel();
  }
};

/// Holds eight doubles; as halves, which stand for two points, what is said of Lanes holds for each of them.
using WideLanes [[gnu::vector_size(64)]] = double;

WHIPPLE_WIDE inline __mmask8 first_bits(std::size_t count) {
  return static_cast<__mmask8>((1U << count) - 1U);
}
/// (A list of eight numbers in a template would become eight masked broadcasts: it is expanded before the target is known.)
WHIPPLE_WIDE inline WideLanes broadcast_wide(double x) { return WideLanes(_mm512_set1_pd(x)); }
WHIPPLE_WIDE inline WideLanes multiply_add(WideLanes a, WideLanes b, WideLanes c) {
  return WideLanes(_mm512_fmadd_pd(__m512d(a), __m512d(b), __m512d(c)));
}
WHIPPLE_WIDE inline WideLanes sqrt(WideLanes x) {
  return WideLanes(
      _mm512_maskz_sqrt_pd(0xff, __m512d(x)));  // (without mask, a warning of uninitialised values)
}
WHIPPLE_WIDE inline WideLanes minimum(WideLanes a, WideLanes b) {
  return WideLanes(_mm512_maskz_min_pd(0xff, __m512d(a), __m512d(b)));
}
WHIPPLE_WIDE inline WideLanes maximum(WideLanes a, WideLanes b) {
  return WideLanes(_mm512_maskz_max_pd(0xff, __m512d(a), __m512d(b)));
}
WHIPPLE_WIDE inline bool all_positive(WideLanes x) {
  return _mm512_cmp_pd_mask(__m512d(x), _mm512_setzero_pd(), _CMP_GT_OQ) == 0xff;
}
WHIPPLE_WIDE inline WideLanes first_lanes(WideLanes x, std::size_t count) {
  return WideLanes(_mm512_maskz_mov_pd(first_bits(count), __m512d(x)));
}
WHIPPLE_WIDE inline WideLanes load_wide(const double* from, std::size_t count = 8) {
  return WideLanes(_mm512_maskz_loadu_pd(first_bits(count), from));
}
WHIPPLE_WIDE inline void store(double* to, WideLanes x, std::size_t count = 8) {
  _mm512_mask_storeu_pd(to, first_bits(count), __m512d(x));
}
/// Transposes pairs of halves: row n in the lower half, row n + 4 in the upper half.
template <std::size_t count>
  requires(count == 8)
WHIPPLE_WIDE inline std::array<WideLanes, 4> transposed(const std::array<Lanes, count>& rows) {
  std::array<WideLanes, 4> pair;
  for (std::size_t n = 0; n < 4; ++n) {
    pair[n] = __builtin_shufflevector(rows[n], rows[n + 4], 0, 1, 2, 3, 4, 5, 6, 7);
  }
  const WideLanes even_low = __builtin_shufflevector(pair[0], pair[1], 0, 8, 2, 10, 4, 12, 6, 14),
                  odd_low = __builtin_shufflevector(pair[0], pair[1], 1, 9, 3, 11, 5, 13, 7, 15),
                  even_high = __builtin_shufflevector(pair[2], pair[3], 0, 8, 2, 10, 4, 12, 6, 14),
                  odd_high = __builtin_shufflevector(pair[2], pair[3], 1, 9, 3, 11, 5, 13, 7, 15);
  return {__builtin_shufflevector(even_low, even_high, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(odd_low, odd_high, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(even_low, even_high, 2, 3, 10, 11, 6, 7, 14, 15),
          __builtin_shufflevector(odd_low, odd_high, 2, 3, 10, 11, 6, 7, 14, 15)};
}
WHIPPLE_WIDE inline WideLanes join(Lanes low, Lanes high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
WHIPPLE_WIDE inline Lanes half(WideLanes v, std::size_t i) {
  return i == 0 ? __builtin_shufflevector(v, v, 0, 1, 2, 3) : __builtin_shufflevector(v, v, 4, 5, 6, 7);
}
WHIPPLE_WIDE inline WideLanes lane(WideLanes v, std::size_t a) {
  switch (a) {
    case 0:
      return __builtin_shufflevector(v, v, 0, 0, 0, 0, 4, 4, 4, 4);
    case 1:
      return __builtin_shufflevector(v, v, 1, 1, 1, 1, 5, 5, 5, 5);
    case 2:
      return __builtin_shufflevector(v, v, 2, 2, 2, 2, 6, 6, 6, 6);
    default:
      return __builtin_shufflevector(v, v, 3, 3, 3, 3, 7, 7, 7, 7);
  }
}
WHIPPLE_WIDE inline WideLanes cycled(WideLanes v) {
  return __builtin_shufflevector(v, v, 1, 2, 0, 3, 5, 6, 4, 7);
}

/// Registers of AVX-512, and how kernels for them are entered.
struct Wide {
  using Register = WideLanes;
  template <class Kernel>
  WHIPPLE_WIDE WHIPPLE_WHOLE_KERNEL static decltype(auto) run(const Kernel& kernel) {
    return kernel();
  }
};
#endif

/// Returns a number in all lanes.
template <class Register>
WHIPPLE_INLINE WHIPPLE_POINT inline Register broadcast(double x) {
  if constexpr (width<Register> == 1) return x;
#ifndef __CUDACC__
  if constexpr (width<Register> == 4) return Register{x, x, x, x};
  if constexpr (width<Register> == 8) return broadcast_wide(x);
#endif
}
#ifndef __CUDACC__
/// Loads the first `count` numbers, at least one; the other lanes are zero.
template <class Register>
WHIPPLE_INLINE inline Register load(const double* from, std::size_t count = width<Register>) {
  if constexpr (width<Register> == 1) return *from;
  if constexpr (width<Register> == 4) return load(from, count, 0.0);
  if constexpr (width<Register> == 8) return load_wide(from, count);
}
#endif

}  // namespace whipple

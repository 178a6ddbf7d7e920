// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include <array>

#include "src/core/base/registers/lanes.hpp"

/// What a register of four doubles does, in instructions of AVX2 (src/core/base/registers/portable.hpp: the same for any
/// processor).
namespace whipple {

/// Loads one number into all lanes.
inline Lanes broadcast_from(const double* from) { return Lanes(_mm256_broadcast_sd(from)); }
/// Loads (stores) four unaligned numbers.
inline Lanes load(const double* from) { return Lanes(_mm256_loadu_pd(from)); }
inline void store(double* to, Lanes x) { _mm256_storeu_pd(to, __m256d(x)); }
/// Loads (stores) three numbers in lanes 0 to 2; lane 3 is 0.
inline Lanes load_vector(const double* from) {
  return Lanes(_mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(from)), _mm_load_sd(from + 2), 1));
}
inline void store_vector(double* to, Lanes x) {
  _mm_storeu_pd(to, _mm256_castpd256_pd128(__m256d(x)));
  _mm_store_sd(to + 2, _mm256_extractf128_pd(__m256d(x), 1));
}
/// Loads numbers from four places.
inline Lanes load_from_four_places(const double* from, const std::uint16_t* places) {
  const __m128i four = _mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(places)));
  const __m256d all =
      _mm256_castsi256_pd(_mm256_set1_epi64x(-1));  // (avoids a compiler warning about uninitialised values)
  return Lanes(_mm256_mask_i32gather_pd(_mm256_setzero_pd(), from, four, all, sizeof(double)));
}
/// Loads four whole numbers.
inline Lanes load_short(const std::uint16_t* from) {
  return Lanes(
      _mm256_cvtepi32_pd(_mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)))));
}

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
/// Rounds towards zero, to whole numbers of 32 bits and as doubles.
inline Indices truncated(Lanes x) { return Indices(_mm256_cvttpd_epi32(__m256d(x))); }
inline Lanes whole_part(Lanes x) {
  return Lanes(_mm256_round_pd(__m256d(x), _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC));
}
inline Lanes as_numbers(Indices i) { return Lanes(_mm256_cvtepi32_pd(__m128i(i))); }
/// Stores the lower 32 bits of the representation of each lane, times a factor, as whole numbers; `to` is aligned.
inline void store_low_bits_times(std::uint64_t* to, Lanes x, std::uint32_t factor) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(to),
                     _mm256_mul_epu32(_mm256_castpd_si256(__m256d(x)), _mm256_set1_epi64x(factor)));
}
/// Returns one bit per lane of a comparison.
inline unsigned bits(LanesMask mask) { return static_cast<unsigned>(_mm256_movemask_pd(__m256d(mask))); }
/// Selects a in lanes where the sign of x is negative, else b, without a comparison.
inline Lanes select_negative(Lanes x, Lanes a, Lanes b) {
  return Lanes(_mm256_blendv_pd(__m256d(b), __m256d(a), __m256d(x)));
}
/// Transposes rows to columns.
inline std::array<Lanes, 4> transposed(const std::array<Lanes, 4>& rows) {
  const auto r0 = __m256d(rows[0]), r1 = __m256d(rows[1]), r2 = __m256d(rows[2]), r3 = __m256d(rows[3]);
  const __m256d a = _mm256_unpacklo_pd(r0, r1), b = _mm256_unpackhi_pd(r0, r1);
  const __m256d c = _mm256_unpacklo_pd(r2, r3), d = _mm256_unpackhi_pd(r2, r3);
  return {Lanes(_mm256_permute2f128_pd(a, c, 0x20)), Lanes(_mm256_permute2f128_pd(b, d, 0x20)),
          Lanes(_mm256_permute2f128_pd(a, c, 0x31)), Lanes(_mm256_permute2f128_pd(b, d, 0x31))};
}

}  // namespace whipple

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "src/core/base/prefetch.hpp"
#include "src/core/base/simd.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/fem/hexahedron.hpp"
#include "src/fem/mesh.hpp"
#include "src/fem/step.hpp"

/// The loops over the elements of a block, element_kernels/, compiled for two register widths, one element per lane:
/// `narrow` for AVX2, four elements at a time, and `wide` for AVX-512, eight. Each lane performs the same operations in
/// the same order in both, and sums over lanes are taken in groups of four, so the results are bitwise identical.
namespace whipple::fem {

inline constexpr double root8 = 2.8284271247461900976;  ///< norm of a mode's corner values
inline constexpr double negligible_cut = 0.02;  ///< energy fraction cut from hourglass forces, not counted
inline constexpr double negligible_energy = 1e-12;  ///< of m c^2, likewise not counted as a limit

/// Holds the quantities common to all groups of elements.
struct DeformationStep {
  Mesh& mesh;
  double dt;
  const HourglassControl& hourglass;
  VelocityGradients& gradient;
};

namespace narrow {

using Vector = Lanes;
constexpr std::size_t width = 4;

WHIPPLE_INLINE inline Vector in_all(double x) { return broadcast(x); }
/// Loads the first `count` lanes, at least one, from memory.
WHIPPLE_INLINE inline Vector load_lanes(const double* from, std::size_t count) {
  return whipple::load(from, count, 0.0);
}
WHIPPLE_INLINE inline void store_lanes(double* to, Vector x, std::size_t count) {
  whipple::store(to, x, count);
}
/// Loads numbers from as many places as there are lanes.
WHIPPLE_INLINE inline Vector gather_lanes(const double* from, const std::uint16_t* places) {
  const __m128i four = _mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(places)));
  const __m256d all =
      _mm256_castsi256_pd(_mm256_set1_epi64x(-1));  // (avoids a compiler warning about uninitialised values)
  return Vector(_mm256_mask_i32gather_pd(_mm256_setzero_pd(), from, four, all, sizeof(double)));
}
WHIPPLE_INLINE inline Vector root(Vector x) { return whipple::sqrt(x); }
WHIPPLE_INLINE inline Vector minimum(Vector a, Vector b) { return whipple::minimum(a, b); }
WHIPPLE_INLINE inline Vector maximum(Vector a, Vector b) { return whipple::maximum(a, b); }
WHIPPLE_INLINE inline bool all_positive(Vector x) { return bits(x > 0.0) == all_lanes; }
WHIPPLE_INLINE inline Vector first_lanes(Vector x, std::size_t count) {
  for (std::size_t l = count; l < width; ++l) x[l] = 0.0;
  return x;
}
/// Loads as many consecutive 3-vectors as there are lanes, by component.
WHIPPLE_INLINE inline std::array<Vector, 3> load_vectors(const double* from) {
  const FourVectors four = load_four_vectors(from);
  return {four.x, four.y, four.z};
}
WHIPPLE_INLINE inline void store_vectors(double* to, Vector x, Vector y, Vector z) {
  const Vector xy = __builtin_shufflevector(x, y, 0, 4, 1, 5), yx = __builtin_shufflevector(x, y, 5, 2, 6, 2),
               xy_last = __builtin_shufflevector(x, y, 3, 7, 3, 7);
  whipple::store(to, __builtin_shufflevector(xy, z, 0, 1, 4, 2));
  whipple::store(to + 4, __builtin_shufflevector(yx, z, 0, 5, 1, 2));
  whipple::store(to + 8, __builtin_shufflevector(xy_last, z, 6, 0, 1, 7));
}
/// Adds the contributions of the elements of a row to the nodes behind and ahead of each of them, to a line of nodes.
/// Elements are processed in groups of four, so that sums are bitwise identical for all register widths.
WHIPPLE_INLINE inline void add_to_line(double* line, Vector behind, Vector before, std::size_t count) {
  behind = first_lanes(behind, count);
  before = first_lanes(before, count);
  const Vector ahead = __builtin_shufflevector(before, Vector{}, 4, 0, 1, 2);
  whipple::store(line, (whipple::load(line) + behind) + ahead);
  line[width] += before[width - 1];
}
/// Transposes four numbers per element (rows) to one register per number (columns).
WHIPPLE_INLINE inline std::array<Vector, 4> columns(const std::array<Lanes, width>& rows) {
  return transposed(rows);
}

#include "src/fem/element_kernels/all.inl"

}  // namespace narrow

#if WHIPPLE_WIDE_KERNELS
#if WHIPPLE_OTHER_TARGET
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v4")
#endif
namespace wide {

using Vector [[gnu::vector_size(64)]] = double;
constexpr std::size_t width = 8;

WHIPPLE_INLINE inline Vector in_all(double x) { return Vector{x, x, x, x, x, x, x, x}; }
WHIPPLE_INLINE inline Vector load_lanes(const double* from, std::size_t count) {
  return Vector(_mm512_maskz_loadu_pd(static_cast<__mmask8>((1U << count) - 1U), from));
}
WHIPPLE_INLINE inline void store_lanes(double* to, Vector x, std::size_t count) {
  _mm512_mask_storeu_pd(to, static_cast<__mmask8>((1U << count) - 1U), __m512d(x));
}
WHIPPLE_INLINE inline Vector gather_lanes(const double* from, const std::uint16_t* places) {
  const __m256i eight = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(places)));
  return Vector(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), 0xff, eight, from, sizeof(double)));
}
WHIPPLE_INLINE inline Vector root(Vector x) { return Vector(_mm512_maskz_sqrt_pd(0xff, __m512d(x))); }
WHIPPLE_INLINE inline Vector minimum(Vector a, Vector b) {
  return Vector(_mm512_maskz_min_pd(0xff, __m512d(a), __m512d(b)));
}
WHIPPLE_INLINE inline Vector maximum(Vector a, Vector b) {
  return Vector(_mm512_maskz_max_pd(0xff, __m512d(a), __m512d(b)));
}
WHIPPLE_INLINE inline bool all_positive(Vector x) {
  return _mm512_cmp_pd_mask(__m512d(x), _mm512_setzero_pd(), _CMP_GT_OQ) == 0xff;
}
WHIPPLE_INLINE inline Vector first_lanes(Vector x, std::size_t count) {
  return Vector(_mm512_maskz_mov_pd(static_cast<__mmask8>((1U << count) - 1U), __m512d(x)));
}
WHIPPLE_INLINE inline void add_to_line(double* line, Vector behind, Vector before, std::size_t count) {
  const unsigned lanes = (1U << count) - 1U, ahead = lanes << 1U, fifth = 1U << 4U;
  const __m512d turned = __m512d(__builtin_shufflevector(before, before, 7, 0, 1, 2, 3, 4, 5, 6));
  __m512d sum = _mm512_loadu_pd(line);
  sum = _mm512_mask_add_pd(sum, static_cast<__mmask8>(ahead & fifth), sum, turned);
  sum = _mm512_mask_add_pd(sum, static_cast<__mmask8>(lanes), sum, __m512d(behind));
  sum = _mm512_mask_add_pd(sum, static_cast<__mmask8>(ahead & ~fifth), sum, turned);
  _mm512_storeu_pd(line, sum);
  line[width] += count == width ? before[width - 1] : 0.0;
}
WHIPPLE_INLINE inline std::array<Vector, 3> load_vectors(const double* from) {
  const Vector a = load_lanes(from, 8), b = load_lanes(from + 8, 8), c = load_lanes(from + 16, 8);
  const Vector x = __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 0, 0),
               y = __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 0, 0, 0),
               z = __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 0, 0, 0);
  return {__builtin_shufflevector(x, c, 0, 1, 2, 3, 4, 5, 10, 13),
          __builtin_shufflevector(y, c, 0, 1, 2, 3, 4, 8, 11, 14),
          __builtin_shufflevector(z, c, 0, 1, 2, 3, 4, 9, 12, 15)};
}
WHIPPLE_INLINE inline void store_vectors(double* to, Vector x, Vector y, Vector z) {
  const Vector a = __builtin_shufflevector(x, y, 0, 8, 0, 1, 9, 1, 2, 10),
               b = __builtin_shufflevector(x, y, 2, 3, 11, 3, 4, 12, 4, 5),
               c = __builtin_shufflevector(x, y, 13, 5, 6, 14, 6, 7, 15, 7);
  store_lanes(to, __builtin_shufflevector(a, z, 0, 1, 8, 3, 4, 9, 6, 7), 8);
  store_lanes(to + 8, __builtin_shufflevector(b, z, 10, 1, 2, 11, 4, 5, 12, 7), 8);
  store_lanes(to + 16, __builtin_shufflevector(c, z, 0, 13, 2, 3, 14, 5, 6, 15), 8);
}
/// Transposes pairs of halves: row n in the lower half, row n + 4 in the upper half.
WHIPPLE_INLINE inline std::array<Vector, 4> columns(const std::array<Lanes, width>& rows) {
  std::array<Vector, 4> pair;
  for (std::size_t n = 0; n < 4; ++n) {
    pair[n] = __builtin_shufflevector(rows[n], rows[n + 4], 0, 1, 2, 3, 4, 5, 6, 7);
  }
  const Vector even_low = __builtin_shufflevector(pair[0], pair[1], 0, 8, 2, 10, 4, 12, 6, 14),
               odd_low = __builtin_shufflevector(pair[0], pair[1], 1, 9, 3, 11, 5, 13, 7, 15),
               even_high = __builtin_shufflevector(pair[2], pair[3], 0, 8, 2, 10, 4, 12, 6, 14),
               odd_high = __builtin_shufflevector(pair[2], pair[3], 1, 9, 3, 11, 5, 13, 7, 15);
  return {__builtin_shufflevector(even_low, even_high, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(odd_low, odd_high, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(even_low, even_high, 2, 3, 10, 11, 6, 7, 14, 15),
          __builtin_shufflevector(odd_low, odd_high, 2, 3, 10, 11, 6, 7, 14, 15)};
}

#include "src/fem/element_kernels/all.inl"

}  // namespace wide
#if WHIPPLE_OTHER_TARGET
#pragma GCC pop_options
#endif
#endif

/// Calls f(Kernels{}) with the kernel set of the processor.
template <class Function>
void with_kernels(Function&& f) {
#if WHIPPLE_WIDE_KERNELS
  if (kernel_set() == KernelSet::wide) return f(wide::Kernels{});
#endif
  f(narrow::Kernels{});
}

}  // namespace whipple::fem

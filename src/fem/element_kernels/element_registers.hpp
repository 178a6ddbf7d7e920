// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "src/core/base/registers.hpp"

/// Memory accesses of the element kernels: fields at nodes, by component, and sums along a line of nodes. Each lane of
/// a register is an element.
namespace whipple::fem {

/// Replicates one number per vector to the twelve components of four vectors, in their order.
inline std::array<Lanes, 3> beside_components(Lanes four) {
  return {__builtin_shufflevector(four, four, 0, 0, 0, 1), __builtin_shufflevector(four, four, 1, 1, 2, 2),
          __builtin_shufflevector(four, four, 2, 3, 3, 3)};
}
inline void store_vectors(double* to, const Triple<Lanes>& v) {
  const Lanes xy = __builtin_shufflevector(v.x, v.y, 0, 4, 1, 5),
              yx = __builtin_shufflevector(v.x, v.y, 5, 2, 6, 2),
              xy_last = __builtin_shufflevector(v.x, v.y, 3, 7, 3, 7);
  store(to, __builtin_shufflevector(xy, v.z, 0, 1, 4, 2));
  store(to + 4, __builtin_shufflevector(yx, v.z, 0, 5, 1, 2));
  store(to + 8, __builtin_shufflevector(xy_last, v.z, 6, 0, 1, 7));
}
/// Adds the contributions of the elements of a row to the nodes behind and ahead of each of them, to a line of nodes.
/// Elements are processed in groups of four, so that sums are bitwise identical for all register widths.
inline void add_to_line(double* line, Lanes behind, Lanes before, std::size_t count) {
  behind = first_lanes(behind, count);
  before = first_lanes(before, count);
  const Lanes ahead = __builtin_shufflevector(before, Lanes{}, 4, 0, 1, 2);
  store(line, (load(line) + behind) + ahead);
  line[4] += before[3];
}

#if WHIPPLE_AVX2
WHIPPLE_WIDE inline Triple<WideLanes> load_eight_vectors(const double* from) {
  const WideLanes a = load_wide(from), b = load_wide(from + 8), c = load_wide(from + 16);
  const WideLanes x = __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 0, 0),
                  y = __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 0, 0, 0),
                  z = __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 0, 0, 0);
  return {__builtin_shufflevector(x, c, 0, 1, 2, 3, 4, 5, 10, 13),
          __builtin_shufflevector(y, c, 0, 1, 2, 3, 4, 8, 11, 14),
          __builtin_shufflevector(z, c, 0, 1, 2, 3, 4, 9, 12, 15)};
}
WHIPPLE_WIDE inline void store_vectors(double* to, const Triple<WideLanes>& v) {
  const WideLanes a = __builtin_shufflevector(v.x, v.y, 0, 8, 0, 1, 9, 1, 2, 10),
                  b = __builtin_shufflevector(v.x, v.y, 2, 3, 11, 3, 4, 12, 4, 5),
                  c = __builtin_shufflevector(v.x, v.y, 13, 5, 6, 14, 6, 7, 15, 7);
  store(to, WideLanes(__builtin_shufflevector(a, v.z, 0, 1, 8, 3, 4, 9, 6, 7)));
  store(to + 8, WideLanes(__builtin_shufflevector(b, v.z, 10, 1, 2, 11, 4, 5, 12, 7)));
  store(to + 16, WideLanes(__builtin_shufflevector(c, v.z, 0, 13, 2, 3, 14, 5, 6, 15)));
}
WHIPPLE_WIDE inline WideLanes load_from_eight_places(const double* from, const std::uint16_t* places) {
  const __m256i eight = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(places)));
  return WideLanes(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), 0xff, eight, from, sizeof(double)));
}
WHIPPLE_WIDE inline void add_to_line(double* line, WideLanes behind, WideLanes before, std::size_t count) {
  const unsigned lanes = (1U << count) - 1U, ahead = lanes << 1U, fifth = 1U << 4U;
  const __m512d shifted = __m512d(__builtin_shufflevector(before, before, 7, 0, 1, 2, 3, 4, 5, 6));
  __m512d sum = _mm512_loadu_pd(line);
  sum = _mm512_mask_add_pd(sum, static_cast<__mmask8>(ahead & fifth), sum, shifted);
  sum = _mm512_mask_add_pd(sum, static_cast<__mmask8>(lanes), sum, __m512d(behind));
  sum = _mm512_mask_add_pd(sum, static_cast<__mmask8>(ahead & ~fifth), sum, shifted);
  _mm512_storeu_pd(line, sum);
  line[8] += count == 8 ? before[7] : 0.0;
}
#else  // named, never called
Triple<WideLanes> load_eight_vectors(const double* from);
WideLanes load_from_eight_places(const double* from, const std::uint16_t* places);
#endif

/// Loads as many consecutive 3-vectors as a register has lanes, by component.
template <class Vector>
WHIPPLE_INLINE inline Triple<Vector> load_vectors_of_group(const double* from) {
  if constexpr (width<Vector> == 4) return load_vectors(from);
  if constexpr (width<Vector> == 8) return load_eight_vectors(from);
}
/// Loads numbers from as many places as a register has lanes.
template <class Vector>
WHIPPLE_INLINE inline Vector load_from_places(const double* from, const std::uint16_t* places) {
  if constexpr (width<Vector> == 4) return load_from_four_places(from, places);
  if constexpr (width<Vector> == 8) return load_from_eight_places(from, places);
}

}  // namespace whipple::fem

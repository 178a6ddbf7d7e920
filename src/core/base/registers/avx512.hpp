// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include <array>
#include <cstddef>

#include "src/core/base/registers/lanes.hpp"
#include "src/core/base/simd.hpp"

/// The register of eight doubles, in instructions of AVX-512. Its functions carry that target and are `inline` only: the
/// compiler then leaves them as calls in templates, which have no target of their own, and inlines them in `Wide::run`;
/// forced inlining would be an error.
namespace whipple {

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

}  // namespace whipple

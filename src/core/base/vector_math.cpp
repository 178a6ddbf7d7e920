// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/vector_math.hpp"

#include <cmath>

namespace whipple {
namespace libmvec {
extern "C" {
#if WHIPPLE_WIDE_KERNELS
[[gnu::const, gnu::target("avx512f")]] __m512d _ZGVeN8v_exp(__m512d);
[[gnu::const, gnu::target("avx512f")]] __m512d _ZGVeN8v_log(__m512d);
#endif
}
}  // namespace libmvec

namespace {

template <double (*function)(double)>
void one_by_one(double* x, std::size_t size) {
  for (std::size_t k = 0; k < size; ++k) x[k] = function(x[k]);
}

#if WHIPPLE_WIDE_KERNELS
template <auto function>
[[gnu::target("avx512f")]] void wide(double* x, std::size_t size) {
  for (std::size_t k = 0; k < size; k += 8) _mm512_storeu_pd(x + k, function(_mm512_loadu_pd(x + k)));
}
#endif

}  // namespace

void exponentials(double* x, std::size_t size) {
  if (kernel_set() == KernelSet::plain) return one_by_one<std::exp>(x, size);
#if WHIPPLE_WIDE_KERNELS
  if (kernel_set() == KernelSet::wide) return wide<libmvec::_ZGVeN8v_exp>(x, size);
#endif
  for (std::size_t k = 0; k < size; k += 4) store(x + k, exp(load(x + k)));
}

void logarithms(double* x, std::size_t size) {
  if (kernel_set() == KernelSet::plain) return one_by_one<std::log>(x, size);
#if WHIPPLE_WIDE_KERNELS
  if (kernel_set() == KernelSet::wide) return wide<libmvec::_ZGVeN8v_log>(x, size);
#endif
  for (std::size_t k = 0; k < size; k += 4) store(x + k, natural_log(load(x + k)));
}

}  // namespace whipple

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/simd.hpp"
#include "src/transfer/plain_kernels.hpp"
#include "src/transfer/register_kernels.hpp"

namespace whipple::transfer {

/// Widest registers for which a kernel is compiled.
enum class Widest { narrow, wide };

/// Calls f(Kernels{}) with the set in use. Rows of nodes in a plane are too short for wide registers.
/// @tparam widest  registers that make the kernel faster (docs/decisions/0022_the_step_as_a_sweep.md)
template <class Shape, Widest widest = Widest::wide, class Function>
void with_kernels(Function&& f) {
  if (kernel_set() == KernelSet::plain) return f(plain::Kernels{});
#if WHIPPLE_WIDE_KERNELS
  if constexpr (!Planar<Shape> && widest == Widest::wide) {
    if (kernel_set() == KernelSet::wide) return f(RegisterKernels<Wide>{});
  }
#endif
  f(RegisterKernels<Narrow>{});
}

}  // namespace whipple::transfer

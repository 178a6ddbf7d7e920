// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/simd.hpp"
#include "src/transfer/plain_kernels.hpp"
#include "src/transfer/register_kernels.hpp"

namespace whipple::transfer {

/// Calls f(Kernels{}) with the set in use. Rows of nodes in a plane are too short for wide registers.
template <class Shape, class Function>
void with_kernels(Function&& f) {
  if (kernel_set() == KernelSet::plain) return f(plain::Kernels{});
#if WHIPPLE_WIDE_KERNELS
  if constexpr (!Planar<Shape>) {
    if (kernel_set() == KernelSet::wide) return f(wide::Kernels{});
  }
#endif
  f(narrow::Kernels{});
}

}  // namespace whipple::transfer

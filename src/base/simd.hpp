// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// A kernel that is compiled twice, with AVX2 and with AVX-512, whose 32 names of vector registers (16
/// before) spare many moves; the loader takes what the processor has. Everything it calls is inlined into
/// both. Once only where the whole program is built for the machine, and under sanitizers, which cannot
/// choose before they run. (The transfers have kernels of their own for each: src/transfer/kernels.hpp.)
#if defined(__x86_64__) && defined(__OPTIMIZE__) && !defined(__clang__) && !defined(__AVX512F__) && \
    !defined(__SANITIZE_ADDRESS__)
#define WHIPPLE_KERNEL [[gnu::target_clones("arch=x86-64-v4", "default"), gnu::flatten, gnu::noinline]]
#else
#define WHIPPLE_KERNEL
#endif

namespace whipple {

/// Four doubles that compute together: the compiler's vector extension, one register under AVX2. The kernels
/// vectorise over the payload of a node (scalar and vector of three), not over particles.
using Lanes [[gnu::vector_size(32)]] = double;

inline Lanes broadcast(double value) { return Lanes{value, value, value, value}; }

/// Sum of the first three lanes.
inline double sum3(Lanes v) { return v[0] + v[1] + v[2]; }

}  // namespace whipple

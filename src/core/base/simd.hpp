// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// A kernel that is compiled twice, with AVX2 and with AVX-512, whose 32 names of vector registers (16
/// before) spare many moves; the loader takes what the processor has. Everything it calls is inlined into
/// both. Once only where the whole program is built for the machine, and under sanitizers, which cannot
/// choose before they run.
#if defined(__x86_64__) && defined(__OPTIMIZE__) && !defined(__clang__) && !defined(__AVX512F__) && \
    !defined(__SANITIZE_ADDRESS__)
#define WHIPPLE_KERNEL [[gnu::target_clones("arch=x86-64-v4", "default"), gnu::flatten, gnu::noinline]]
#else
#define WHIPPLE_KERNEL
#endif

/// Kernels whose source is included twice, for the registers of AVX2 and of AVX-512:
/// src/transfer/register_kernels.hpp, src/fem/element_kernels.hpp. Sanitizers, which take minutes for functions of
/// that size, get those for AVX2 in pieces.
#if defined(__x86_64__) && defined(__OPTIMIZE__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define WHIPPLE_WIDE_KERNELS 1
#else
#define WHIPPLE_WIDE_KERNELS 0
#endif
#if WHIPPLE_WIDE_KERNELS && !defined(__AVX512F__)  // else the whole program is built for such a machine
#define WHIPPLE_OTHER_TARGET 1
#else
#define WHIPPLE_OTHER_TARGET 0
#endif

#ifdef __SANITIZE_ADDRESS__
#define WHIPPLE_INLINE
#define WHIPPLE_WHOLE_KERNEL
#else
#define WHIPPLE_INLINE __attribute__((always_inline))
#define WHIPPLE_WHOLE_KERNEL [[gnu::flatten, gnu::noinline]]
#endif

namespace whipple {

/// Sets of kernels of the transfers and of the vector functions. They agree to round-off; those for registers bit for
/// bit.
enum class KernelSet : std::uint8_t {
  plain,   ///< loops over single numbers: the reference
  narrow,  ///< for AVX2
  wide,    ///< for AVX-512
};
/// Returns the set in use: the widest that the processor has, until the program or a test selects another.
inline KernelSet& kernel_set() {
#if WHIPPLE_WIDE_KERNELS
  static KernelSet set = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                                 __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                                 __builtin_cpu_supports("avx512cd")
                             ? KernelSet::wide
                             : KernelSet::narrow;
#else
  static KernelSet set = KernelSet::narrow;
#endif
  return set;
}

/// Four doubles that compute together: the compiler's vector extension, one register under AVX2. The kernels
/// vectorise over the payload of a node (scalar and vector of three), not over particles.
using Lanes [[gnu::vector_size(32)]] = double;

inline Lanes broadcast(double value) { return Lanes{value, value, value, value}; }

/// Sum of the first three lanes.
inline double sum3(Lanes v) { return v[0] + v[1] + v[2]; }
inline double sum4(Lanes v) { return v[0] + v[1] + v[2] + v[3]; }

}  // namespace whipple

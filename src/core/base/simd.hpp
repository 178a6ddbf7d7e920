// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// Tells whether every processor that the program is for has AVX2 (preset `release`); if not, registers of four doubles
/// are what the compiler makes of them (src/core/base/registers/portable.hpp).
#if defined(__AVX2__) && defined(__FMA__)
#define WHIPPLE_AVX2 1
#else
#define WHIPPLE_AVX2 0
#endif

/// Marks a kernel that is compiled twice, for AVX2 and for AVX-512, whose 32 vector registers (instead of 16) avoid
/// many moves; the loader selects the version for the processor. All called functions are inlined into both. There is
/// only one version if the whole program is built for the machine, and under sanitizers, which do not support selection
/// by the loader.
#if WHIPPLE_AVX2 && defined(__OPTIMIZE__) && !defined(__clang__) && !defined(__AVX512F__) && \
    !defined(__SANITIZE_ADDRESS__)
#define WHIPPLE_KERNEL [[gnu::target_clones("arch=x86-64-v4", "default"), gnu::flatten, gnu::noinline]]
#else
#define WHIPPLE_KERNEL
#endif

/// Enables kernels that are instantiated for AVX2 and for AVX-512 registers (src/core/base/registers.hpp): those of
/// src/transfer and src/fem. Sanitizers, which take minutes for functions of that size, use the AVX2 versions without
/// inlining.
#if WHIPPLE_AVX2 && defined(__OPTIMIZE__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define WHIPPLE_WIDE_KERNELS 1
#else
#define WHIPPLE_WIDE_KERNELS 0
#endif
/// Marks a function with instructions of AVX-512, unless the whole program is built for it, or without any.
#if defined(__AVX512F__) || !WHIPPLE_AVX2
#define WHIPPLE_WIDE
#else
#define WHIPPLE_WIDE [[gnu::target("arch=x86-64-v4")]]
#endif

#ifdef __SANITIZE_ADDRESS__
#define WHIPPLE_INLINE
#define WHIPPLE_WHOLE_KERNEL
#else
#define WHIPPLE_INLINE __attribute__((always_inline))
#define WHIPPLE_WHOLE_KERNEL [[gnu::flatten, gnu::noinline]]
#endif

namespace whipple {

/// Lists the sets of kernels of the transfers and of the vector functions. They agree to round-off; the register
/// versions agree bitwise.
enum class KernelSet : std::uint8_t {
  plain,   ///< scalar loops: the reference
  narrow,  ///< for AVX2, or for processors without it
  wide,    ///< for AVX-512
};
/// Returns the set in use: the widest one supported by the processor, unless the program or a test selects another.
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

}  // namespace whipple

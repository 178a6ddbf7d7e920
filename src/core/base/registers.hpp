// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "src/core/base/simd.hpp"
#include "src/core/base/triple.hpp"
#ifndef __CUDACC__  // kernels of a graphics processor take single numbers
#if WHIPPLE_AVX2
#include "src/core/base/registers/avx2.hpp"
#include "src/core/base/registers/avx512.hpp"
#else
#include "src/core/base/registers/portable.hpp"
#endif
#endif

/// Numbers that are processed together, under the same names for each width: one `double`, the four of an AVX2 register
/// (Lanes; on other processors, of several registers), the eight of an AVX-512 register (WideLanes). A kernel is a
/// template on the register and is entered through `Narrow::run` or `Wide::run`, which is compiled for the processor and
/// inlines all that the kernel calls.
namespace whipple {

/// Counts the numbers of a register.
template <class Register>
constexpr std::size_t width = sizeof(Register) / sizeof(double);  // NOLINT(bugprone-sizeof-expression)

// A number.
WHIPPLE_POINT inline double multiply_add(double a, double b, double c) { return std::fma(a, b, c); }
/// Returns the smaller (larger) number as the instruction does: b if one is NaN.
WHIPPLE_POINT inline double minimum(double a, double b) { return a < b ? a : b; }
WHIPPLE_POINT inline double maximum(double a, double b) { return a > b ? a : b; }
inline bool any(bool mask) { return mask; }
inline bool all_positive(double x) { return x > 0.0; }
WHIPPLE_POINT inline double select(bool mask, double a, double b) { return mask ? a : b; }
/// Returns the logarithm (exponential) of a number, for formulas written for any width.
WHIPPLE_POINT inline double natural_log(double x) { return std::log(x); }
WHIPPLE_POINT inline double exponential(double x) { return std::exp(x); }

#ifndef __CUDACC__
/// Loads (stores) the first `count` numbers; the other lanes are set to `rest`.
inline Lanes load(const double* from, std::size_t count, double rest) {
  if (count >= 4) return load(from);
  Lanes x = broadcast(rest);
  for (std::size_t i = 0; i < count; ++i) x[i] = from[i];
  return x;
}
inline void store(double* to, Lanes x, std::size_t count) {
  if (count >= 4) return store(to, x);
  for (std::size_t i = 0; i < count; ++i) to[i] = x[i];
}

/// Returns the sum of the first three lanes.
inline double sum3(Lanes v) { return v[0] + v[1] + v[2]; }
inline double sum4(Lanes v) { return v[0] + v[1] + v[2] + v[3]; }

/// Returns lanes 0 to 2, rounded down.
inline std::array<int, 3> floor_of_three(Lanes x) {
  const Indices down = truncated(floor(x));
  return {down[0], down[1], down[2]};
}
inline constexpr unsigned all_lanes = 15;
inline bool any(LanesMask mask) { return bits(mask) != 0; }
inline bool all_positive(Lanes x) { return bits(x > 0.0) == all_lanes; }
inline Lanes select(LanesMask mask, Lanes a, Lanes b) { return mask ? a : b; }
/// Returns x with lanes from `count` on set to zero.
inline Lanes first_lanes(Lanes x, std::size_t count) {
  for (std::size_t l = count; l < 4; ++l) x[l] = 0.0;
  return x;
}
/// Loads four consecutive 3-vectors, by component.
inline Triple<Lanes> load_vectors(const double* from) {
  const Lanes a = load(from), b = load(from + 4), c = load(from + 8);  // x y z x, y z x y, z x y z
  const Lanes ab_x = __builtin_shufflevector(a, b, 0, 3, 6, 6),
              ab_y = __builtin_shufflevector(a, b, 1, 4, 7, 7),
              ab_z = __builtin_shufflevector(a, b, 2, 5, 5, 5);
  return {__builtin_shufflevector(ab_x, c, 0, 1, 2, 5), __builtin_shufflevector(ab_y, c, 0, 1, 2, 6),
          __builtin_shufflevector(ab_z, c, 0, 1, 4, 7)};
}

// A register whose lanes 0 to 2 are a vector.
/// Returns lane a in all lanes.
inline Lanes lane(Lanes v, std::size_t a) { return broadcast(v[a]); }
/// Returns lanes 1, 2, 0, 3.
inline Lanes cycled(Lanes v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); }

/// Registers of four doubles, and how kernels for them are entered.
struct Narrow {
  using Register = Lanes;
  template <class Kernel>
  WHIPPLE_WHOLE_KERNEL static decltype(auto) run(const Kernel& kernel) {
    return kernel();
  }
};

#endif

/// Returns a number in all lanes.
template <class Register>
WHIPPLE_INLINE WHIPPLE_POINT inline Register broadcast(double x) {
  if constexpr (width<Register> == 1) return x;
#ifndef __CUDACC__
  if constexpr (width<Register> == 4) return Register{x, x, x, x};
  if constexpr (width<Register> == 8) return broadcast_wide(x);
#endif
}
#ifndef __CUDACC__
/// Loads the first `count` numbers, at least one; the other lanes are zero.
template <class Register>
WHIPPLE_INLINE inline Register load(const double* from, std::size_t count = width<Register>) {
  if constexpr (width<Register> == 1) return *from;
  if constexpr (width<Register> == 4) return load(from, count, 0.0);
  if constexpr (width<Register> == 8) return load_wide(from, count);
}
#endif

}  // namespace whipple

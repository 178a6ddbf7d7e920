// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cmath>

#include "src/core/base/registers/lanes.hpp"

/// What a register of four doubles does, lane by lane, for processors without AVX2. The same numbers as
/// src/core/base/registers/avx2.hpp, bit by bit, NaN and zeros included.
namespace whipple {

/// Applies a function of numbers to each lane.
template <class Function>
inline Lanes by_lane(const Function& function) {
  return Lanes{function(0), function(1), function(2), function(3)};
}

/// Loads one number into all lanes.
inline Lanes broadcast_from(const double* from) { return broadcast(*from); }
/// Loads (stores) four unaligned numbers.
inline Lanes load(const double* from) { return Lanes{from[0], from[1], from[2], from[3]}; }
inline void store(double* to, Lanes x) {
  for (std::size_t l = 0; l < 4; ++l) to[l] = x[l];
}
/// Loads (stores) three numbers in lanes 0 to 2; lane 3 is 0.
inline Lanes load_vector(const double* from) { return Lanes{from[0], from[1], from[2], 0.0}; }
inline void store_vector(double* to, Lanes x) {
  for (std::size_t l = 0; l < 3; ++l) to[l] = x[l];
}
/// Loads numbers from four places.
inline Lanes load_from_four_places(const double* from, const std::uint16_t* places) {
  return by_lane([&](std::size_t l) { return from[places[l]]; });
}
/// Loads four whole numbers.
inline Lanes load_short(const std::uint16_t* from) {
  return by_lane([&](std::size_t l) { return static_cast<double>(from[l]); });
}

/// Returns a b + c, rounded once: used explicitly where two implementations must agree bitwise.
inline Lanes multiply_add(Lanes a, Lanes b, Lanes c) {
  return by_lane([&](std::size_t l) { return std::fma(a[l], b[l], c[l]); });
}
inline Lanes sqrt(Lanes x) {
  return by_lane([&](std::size_t l) { return std::sqrt(x[l]); });
}
/// Returns the smaller (larger) value per lane; b if one is NaN.
inline Lanes minimum(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes maximum(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes floor(Lanes x) {
  return by_lane([&](std::size_t l) { return std::floor(x[l]); });
}
inline Lanes absolute(Lanes x) {
  return by_lane([&](std::size_t l) { return std::fabs(x[l]); });
}
/// Rounds towards zero, to whole numbers of 32 bits and as doubles.
inline Indices truncated(Lanes x) {
  const auto whole = [&](std::size_t l) { return static_cast<std::int32_t>(x[l]); };
  return Indices{whole(0), whole(1), whole(2), whole(3)};
}
inline Lanes whole_part(Lanes x) {
  return by_lane([&](std::size_t l) { return std::trunc(x[l]); });
}
inline Lanes as_numbers(Indices i) {
  return by_lane([&](std::size_t l) { return static_cast<double>(i[l]); });
}
/// Stores the lower 32 bits of the representation of each lane, times a factor, as whole numbers; `to` is aligned.
inline void store_low_bits_times(std::uint64_t* to, Lanes x, std::uint32_t factor) {
  for (std::size_t l = 0; l < 4; ++l) {
    const double number = x[l];
    to[l] = (std::bit_cast<std::uint64_t>(number) & 0xffffffffU) * factor;
  }
}
/// Returns one bit per lane of a comparison.
inline unsigned bits(LanesMask mask) {
  return (mask[0] != 0 ? 1U : 0U) | (mask[1] != 0 ? 2U : 0U) | (mask[2] != 0 ? 4U : 0U) |
         (mask[3] != 0 ? 8U : 0U);
}
/// Selects a in lanes where the sign of x is negative, else b, without a comparison.
inline Lanes select_negative(Lanes x, Lanes a, Lanes b) {
  return by_lane([&](std::size_t l) { return std::signbit(x[l]) ? a[l] : b[l]; });
}
/// Transposes rows to columns.
inline std::array<Lanes, 4> transposed(const std::array<Lanes, 4>& rows) {
  std::array<Lanes, 4> columns;
  for (std::size_t l = 0; l < 4; ++l) columns[l] = Lanes{rows[0][l], rows[1][l], rows[2][l], rows[3][l]};
  return columns;
}

// Named by templates in their branch for registers of eight numbers (src/core/base/registers/avx512.hpp), which is never
// taken here: not defined.
using WideLanes [[gnu::vector_size(64)]] = double;
WideLanes broadcast_wide(double x);
WideLanes load_wide(const double* from, std::size_t count);
WideLanes join(Lanes low, Lanes high);
Lanes half(WideLanes v, std::size_t i);

}  // namespace whipple

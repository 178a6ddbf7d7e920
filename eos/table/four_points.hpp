// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "eos/table/kernel.hpp"
#include "src/core/base/vector_math.hpp"

/// Evaluates the polynomials of a table in registers: the curves of a strip four at a time, cells for four points.
namespace whipple::eos::table {

/// Evaluates the curves of a strip.
/// @param tx  position in the strip, from 0 to 1
inline Curves curves(const TableData& data, const TableData::Strip& strip, double tx) {
  const Piece at = piece(tx, strip.intervals);
  const double scale = strip.intervals * strip.inverse_length;
  Curves result{};
  for (std::uint32_t block = 0; block < strip.blocks(); ++block) {
    const TableData::Interval& c = data.intervals[strip.first_interval + at.index * strip.blocks() + block];
    Lanes value, slope, half_curvature;
    horner([&](std::size_t i) { return c[i]; }, broadcast(at.local), value, slope, half_curvature);
    store(&result.value[4 * block], value);
    store(&result.slope[4 * block], slope * scale);
    store(&result.curvature[4 * block], half_curvature * (2 * scale * scale));
  }
  return result;
}

/// Holds the result of the first of two steps that evaluate four points at once: for each point, the sums over the
/// powers of x, with first and half of second derivatives, for each power of y.
using AlongX =
    std::array<double, 20>;  ///< powers 0 to 3 of the value, slope, curvature; powers 4 and 5; two unused

inline void along_x(const double* cell, double tx, AlongX& sums) {
  Lanes a0, a1, a2;
  Pair b0, b1, b2;
  horner([&](std::size_t j) { return load(cell + 6 * j); }, broadcast(tx), a0, a1, a2);
  horner([&](std::size_t j) { return load_pair(cell + 6 * j + 4); }, Pair{tx, tx}, b0, b1, b2);
  store(&sums[0], a0);
  store(&sums[4], a1);
  store(&sums[8], a2);
  store(&sums[12], b0);
  store(&sums[14], b1);
  store(&sums[16], b2);
}

/// Returns four numbers of four points, ordered by number.
inline std::array<Lanes, 4> transposed(const AlongX* sums, std::size_t first) {
  const auto row = [&](std::size_t point) { return load(&sums[point][first]); };
  return whipple::transposed({row(0), row(1), row(2), row(3)});
}

/// Performs the second step: the sums over the powers of y.
inline Polynomial<Lanes> along_y(const AlongX* sums, Lanes ty) {
  const auto v = transposed(sums, 0), s = transposed(sums, 4), h = transposed(sums, 8);
  const auto vs = transposed(sums, 12), hs = transposed(sums, 16);
  Polynomial<Lanes> result;
  Lanes value, half;
  horner([&](std::size_t i) { return i < 4 ? v[i] : vs[i - 4]; }, ty, value, result.y, half);
  result.yy = 2.0 * half;
  horner([&](std::size_t i) { return i < 4 ? s[i] : vs[i - 2]; }, ty, result.x, result.xy, half);
  horner([&](std::size_t i) { return i < 4 ? h[i] : hs[i - 4]; }, ty, result.xx, value, half);
  result.xx *= 2.0;
  return result;
}

}  // namespace whipple::eos::table

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "src/core/base/vector_math.hpp"

namespace whipple::eos {

/// Four functions of one variable that are wanted together, as polynomials of degree five on equal cells, the
/// edge of two of which may be a kink: error of order width^6, so that the table stays in a first-level
/// cache. A coefficient of all four functions is one register, and each of four arguments reads one run of
/// memory. The polynomials pass through the functions at Chebyshev-Lobatto points, both ends of the cell
/// among them, and are continuous.
class FourfoldTable {
 public:
  using Values = std::array<double, 4>;
  using Functions = std::function<Values(double)>;

  FourfoldTable() = default;
  /// Halves the width of the cells until the polynomials miss the functions by less than `tolerance` (in
  /// units of the value plus `scale`) at points between, or until there are `most_cells` of them. The
  /// functions are sampled up to one cell beyond `end`.
  FourfoldTable(const Functions& below, const Functions& above, double begin, double kink, double end,
                const Values& scale, double tolerance = 1e-13, int most_cells = 1024);

  /// Where four arguments lie, begin <= x <= end. A step of its own: over a few groups of points first this,
  /// then the functions, or else each group is one chain of operations too long for the processor to begin
  /// the next ones meanwhile.
  struct Places {
    alignas(32) std::array<double, 4> distance;     ///< from the centre of the cell, in widths
    alignas(32) std::array<std::uint64_t, 4> cell;  ///< bytes from the first one
  };
  void find(Lanes x, Places& places) const {
    // A sum with 3/2 2^52 is rounded to whole cells, whose number is then in the low bits.
    constexpr double rounding = 0x1.8p52;
    const Lanes from_first = x - first_;
    const Lanes rounded = from_first * per_width_ + rounding;
    store(places.distance.data(), from_first * per_width_ - (rounded - rounding));
    _mm256_store_si256(
        reinterpret_cast<__m256i*>(places.cell.data()),
        _mm256_mul_epu32(_mm256_castpd_si256(__m256d(rounded)), _mm256_set1_epi64x(sizeof(Cell))));
  }
  /// The four functions at four arguments.
  [[nodiscard]] std::array<Lanes, 4> operator()(const Places& places) const {
    const auto* const cells = reinterpret_cast<const std::byte*>(cells_.data());
    const auto at_point = [&](std::size_t i) {
      return at(*reinterpret_cast<const Cell*>(cells + places.cell[i]), broadcast(places.distance[i]));
    };
    return transposed({at_point(0), at_point(1), at_point(2), at_point(3)});
  }
  [[nodiscard]] std::size_t cells() const { return cells_.size(); }

 private:
  static constexpr std::size_t terms = 6;
  using Cell = std::array<Lanes, terms>;  ///< powers of the distance from its centre, in widths

  [[nodiscard]] static Lanes at(const Cell& cell, Lanes t) {
    Lanes value = cell[terms - 1];
    for (std::size_t i = terms - 1; i-- > 0;) value = value * t + cell[i];
    return value;
  }

  std::vector<Cell> cells_;
  double first_ = 0;  ///< centre of the first cell
  double per_width_ = 0;
};

}  // namespace whipple::eos

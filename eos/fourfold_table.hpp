// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "src/core/base/vector_math.hpp"

namespace whipple::eos {

/// Approximates four functions of one variable that are evaluated together by polynomials of degree five on equal
/// cells, with an optional kink at one cell boundary: the error is of order width^6, so that the table fits into a
/// first-level cache. A coefficient of all four functions is one register, and each of four arguments reads
/// contiguous memory. The polynomials interpolate the functions at Chebyshev-Lobatto points, including both ends of
/// the cell, and are continuous.
class FourfoldTable {
 public:
  using Values = std::array<double, 4>;
  using Functions = std::function<Values(double)>;

  FourfoldTable() = default;
  /// Halves the width of the cells until the error of the polynomials is below `tolerance` (in units of the value
  /// plus `scale`) at intermediate points, or until there are `most_cells` of them. The functions are sampled up to
  /// one cell beyond `end`.
  FourfoldTable(const Functions& below, const Functions& above, double begin, double kink, double end,
                const Values& scale, double tolerance = 1e-13, int most_cells = 1024);

  /// Holds the positions of four arguments, begin <= x <= end. Finding them is a separate step, done for several
  /// groups of points before the functions are evaluated; otherwise each group is one dependency chain too long for
  /// the processor to overlap with the next.
  struct Places {
    alignas(32) std::array<double, 4> distance;     ///< from the centre of the cell, in widths
    alignas(32) std::array<std::uint64_t, 4> cell;  ///< byte offset from the first one
  };
  void find(Lanes x, Places& places) const {
    // Adding 3/2 2^52 rounds to whole cells, with the cell number in the low bits.
    constexpr double rounding = 0x1.8p52;
    const Lanes from_first = x - first_;
    const Lanes rounded = from_first * per_width_ + rounding;
    store(places.distance.data(), from_first * per_width_ - (rounded - rounding));
    store_low_bits_times(places.cell.data(), rounded, sizeof(Cell));
  }
  /// Evaluates the four functions at four arguments.
  [[nodiscard]] std::array<Lanes, 4> operator()(const Places& places) const {
    const auto* const cells = reinterpret_cast<const std::byte*>(cells_.data());
    const auto at_point = [&](std::size_t i) {
      return at(*reinterpret_cast<const Cell*>(cells + places.cell[i]), broadcast(places.distance[i]));
    };
    return transposed({at_point(0), at_point(1), at_point(2), at_point(3)});
  }
  [[nodiscard]] std::size_t cells() const { return cells_.size(); }
  /// Returns the centre of the first cell, and the inverse of their width.
  [[nodiscard]] double first() const { return first_; }
  [[nodiscard]] double per_width() const { return per_width_; }
  /// Appends the coefficients: by cell, by power, and of the four functions.
  void append_to(std::vector<double>& numbers) const {
    for (const Cell& cell : cells_) {
      for (const Lanes& of_power : cell)
        numbers.insert(numbers.end(), {of_power[0], of_power[1], of_power[2], of_power[3]});
    }
  }

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

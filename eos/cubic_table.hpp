// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "src/core/base/vector_math.hpp"

namespace whipple::eos {

/// Approximates a smooth function on [0, end] by cubics on equal intervals, for four arguments at once: each
/// interval is one register of coefficients, so that four look-ups are four loads and a transposition. The cubic
/// interpolates the function at four Chebyshev-Lobatto points, including both ends: continuous, error of order
/// step^4.
class CubicTable {
 public:
  CubicTable() = default;
  /// Doubles the number of intervals until the error of the cubics is below `tolerance` (in units of the function
  /// value plus `scale`) at intermediate points, or until there are `most_intervals`.
  CubicTable(const std::function<double(double)>& function, double end, double scale,
             double tolerance = 1e-13, int most_intervals = 4096);

  /// Evaluates the table; below 0 the first polynomial is continued, beyond the end the last.
  [[nodiscard]] Lanes operator()(Lanes x) const {
    const Lanes position = x * inverse_step_;
    const Indices index = truncated(minimum(maximum(position, broadcast(0.0)), broadcast(last_interval_)));
    const Lanes t = position - as_numbers(index);
    const Piece* first = pieces_.data();
    const auto piece = [&](int i) { return load(first[static_cast<unsigned>(i)].data()); };
    const auto [c0, c1, c2, c3] =
        transposed({piece(index[0]), piece(index[1]), piece(index[2]), piece(index[3])});
    return c0 + t * (c1 + t * (c2 + t * c3));
  }
  [[nodiscard]] std::size_t intervals() const { return pieces_.size(); }

 private:
  struct alignas(32) Piece : std::array<double, 4> {};
  std::vector<Piece> pieces_ = std::vector<Piece>(1);  ///< empty table: zero
  double inverse_step_ = 1, last_interval_ = 0;
};

}  // namespace whipple::eos

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace whipple::eos {

/// Fits a piecewise quintic through equidistant samples: twice continuously differentiable, error of order h^6 in
/// the value. Slopes and curvatures at the ends of the cells are nine-point differences of the samples.
class HermiteFit {
 public:
  static constexpr std::size_t least_intervals = 8;
  /// Returns the intervals of the samples for `cells` cells: a multiple of `cells`, and also a power of two.
  static std::size_t sample_intervals(std::size_t cells);

  /// @param cells  a power of two
  explicit HermiteFit(std::size_t cells);

  /// Computes coefficients of 1, t, ..., t^5 in each cell, t from 0 to 1.
  /// @param samples first of sample_intervals(cells) + 1 samples, `stride` apart
  /// @param result  first of cells * 6 coefficients, `result_stride` apart
  void operator()(const double* samples, std::size_t stride, double* result, std::size_t result_stride) const;

 private:
  struct Node {
    std::size_t first;              ///< index of the first of the nine samples
    double slope[9], curvature[9];  ///< weights, in units of the cell
  };
  std::size_t cells_, per_cell_;
  std::vector<Node> nodes_;
};

}  // namespace whipple::eos

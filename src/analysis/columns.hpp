// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/analysis/frame.hpp"

namespace whipple::analysis {

/// Thickness of the material of a body along the axis, in columns of two cells over the face of the model: says
/// whether a plate is open anywhere, wherever it was hit.
class Columns {
 public:
  /// @param size  edge of the columns, m
  Columns(const Snapshot& first, const Frame& frame, std::size_t body, double size);

  /// Least fraction of its initial thickness that is left in any column, of material that is slower than debris;
  /// the rim of the body, thinner parts of it and columns cut by the domain do not count. 1 if the body has no
  /// column that counts.
  [[nodiscard]] double least_left(const Snapshot& snapshot) const;

 private:
  [[nodiscard]] std::vector<double> thickness(const Snapshot& snapshot, bool all) const;

  Frame frame_;
  std::size_t body_;
  double size_;
  std::array<double, 2> lower_{}, upper_{};    // of the body, across the axis
  std::array<std::ptrdiff_t, 2> count_{};      // of columns
  std::vector<double> initial_;                // m
  std::vector<std::size_t> inside_;            // columns that count
};

}  // namespace whipple::analysis

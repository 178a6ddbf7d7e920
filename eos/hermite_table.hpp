// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace whipple::eos {

/// Quintic Hermite interpolation on a uniform grid from exact values and first and second derivatives: error
/// of order step^6, twice continuously differentiable.
class HermiteTable {
 public:
  /// Values at one node: f, f', f''.
  struct Node {
    double value = 0, slope = 0, curvature = 0;
  };
  HermiteTable() = default;
  /// @param nodes at least two, at begin + i step
  HermiteTable(double begin, double step, std::vector<Node> nodes)
      : begin_(begin), inverse_step_(1 / step), nodes_(std::move(nodes)) {
    for (Node& node : nodes_) {  // derivatives in units of the step
      node.slope *= step;
      node.curvature *= step * step;
    }
  }

  /// Outside the grid the last polynomial continues.
  [[nodiscard]] double operator()(double x) const {
    const double position = (x - begin_) * inverse_step_;
    const auto i =
        static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(nodes_.size() - 2)));
    const double t = position - static_cast<double>(i);
    const Node &l = nodes_[i], &r = nodes_[i + 1];
    const double d0 = r.value - (l.value + l.slope + 0.5 * l.curvature);
    const double d1 = r.slope - (l.slope + l.curvature);
    const double d2 = r.curvature - l.curvature;
    const double c3 = 10 * d0 - 4 * d1 + 0.5 * d2;
    const double c4 = -15 * d0 + 7 * d1 - d2;
    const double c5 = 6 * d0 - 3 * d1 + 0.5 * d2;
    return l.value + t * (l.slope + t * (0.5 * l.curvature + t * (c3 + t * (c4 + t * c5))));
  }

 private:
  double begin_ = 0, inverse_step_ = 1;
  std::vector<Node> nodes_;
};

}  // namespace whipple::eos

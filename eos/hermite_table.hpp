// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/core/base/vector_math.hpp"

namespace whipple::eos {

/// Interpolates by quintic Hermite polynomials on a uniform grid of exact values and first and second derivatives:
/// error of order step^6, twice continuously differentiable.
class HermiteTable {
 public:
  /// Holds the values at one node: f, f', f''.
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

  /// Evaluates the interpolant; outside the grid the last polynomial is continued.
  [[nodiscard]] double operator()(double x) const {
    const Polynomial f = polynomial(x);
    return f.c0 + f.t * (f.c1 + f.t * (f.c2 + f.t * (f.c3 + f.t * (f.c4 + f.t * f.c5))));
  }

  /// Evaluates four values at once; not bitwise equal to the scalar evaluation.
  [[nodiscard]] Lanes operator()(Lanes x) const {
    const Lanes position = (x - begin_) * inverse_step_;
    const auto last = static_cast<double>(nodes_.size() - 2);
    const Indices cell = truncated(minimum(maximum(position, broadcast(0.0)), broadcast(last)));
    alignas(16) std::int32_t index[4];
    store(index, cell);
    // Two neighbouring nodes are six numbers in a row: f, f', f'' of the left one, then of the right one.
    static_assert(sizeof(Node) == 3 * sizeof(double));
    std::array<Lanes, 4> rows;
    Pair tails[4];
    for (std::size_t i = 0; i < 4; ++i) {
      const double* const node = &nodes_[static_cast<std::size_t>(index[i])].value;
      rows[i] = load(node);
      tails[i] = load_pair(node + 4);
    }
    const auto [f, f1, f2, r] = transposed(rows);
    const Lanes left = __builtin_shufflevector(tails[0], tails[2], 0, 1, 2, 3),
                right = __builtin_shufflevector(tails[1], tails[3], 0, 1, 2, 3);
    const Lanes r1 = __builtin_shufflevector(left, right, 0, 4, 2, 6),
                r2 = __builtin_shufflevector(left, right, 1, 5, 3, 7);
    const Lanes t = position - as_numbers(cell);
    const Lanes d0 = r - (f + f1 + 0.5 * f2), d1 = r1 - (f1 + f2), d2 = r2 - f2;
    const Lanes c3 = 10.0 * d0 - 4.0 * d1 + 0.5 * d2;
    const Lanes c4 = -15.0 * d0 + 7.0 * d1 - d2;
    const Lanes c5 = 6.0 * d0 - 3.0 * d1 + 0.5 * d2;
    return f + t * (f1 + t * (0.5 * f2 + t * (c3 + t * (c4 + t * c5))));
  }

  /// Returns value and exact derivatives of the interpolant.
  [[nodiscard]] Node at(double x) const {
    const Polynomial f = polynomial(x);
    const double t = f.t;
    return {f.c0 + t * (f.c1 + t * (f.c2 + t * (f.c3 + t * (f.c4 + t * f.c5)))),
            inverse_step_ * (f.c1 + t * (2 * f.c2 + t * (3 * f.c3 + t * (4 * f.c4 + t * 5 * f.c5)))),
            inverse_step_ * inverse_step_ * (2 * f.c2 + t * (6 * f.c3 + t * (12 * f.c4 + t * 20 * f.c5)))};
  }

 private:
  /// Holds c0 + c1 t + ... + c5 t^5 on the interval that contains x, t in units of the step.
  struct Polynomial {
    double t, c0, c1, c2, c3, c4, c5;
  };
  [[nodiscard]] Polynomial polynomial(double x) const {
    const double position = (x - begin_) * inverse_step_;
    const auto i =
        static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(nodes_.size() - 2)));
    const Node &l = nodes_[i], &r = nodes_[i + 1];
    const double d0 = r.value - (l.value + l.slope + 0.5 * l.curvature);
    const double d1 = r.slope - (l.slope + l.curvature);
    const double d2 = r.curvature - l.curvature;
    return {position - static_cast<double>(i),
            l.value,
            l.slope,
            0.5 * l.curvature,
            10 * d0 - 4 * d1 + 0.5 * d2,
            -15 * d0 + 7 * d1 - d2,
            6 * d0 - 3 * d1 + 0.5 * d2};
  }

  double begin_ = 0, inverse_step_ = 1;
  std::vector<Node> nodes_;
};

}  // namespace whipple::eos

// SPDX-License-Identifier: BSD-3-Clause
#include "eos/table/hermite_fit.hpp"

#include <algorithm>
#include <array>

namespace whipple::eos {
namespace {

constexpr std::size_t width = HermiteFit::least_intervals + 1;

/// Returns the weights of the first and second derivative at `at` over the nodes 0, 1, ..., width - 1: B. Fornberg,
/// Math. Comp. 51, 699 (1988).
std::array<std::array<double, width>, 3> difference_weights(double at) {
  std::array<std::array<double, width>, 3> c{};
  c[0][0] = 1;
  double c1 = 1, c4 = -at;
  for (std::size_t i = 1; i < width; ++i) {
    const std::size_t order = std::min<std::size_t>(i, 2);
    double c2 = 1;
    const double c5 = c4;
    c4 = static_cast<double>(i) - at;
    for (std::size_t j = 0; j < i; ++j) {
      const double c3 = static_cast<double>(i) - static_cast<double>(j);
      c2 *= c3;
      if (j == i - 1) {
        for (std::size_t k = order; k > 0; --k)
          c[k][i] = c1 * (static_cast<double>(k) * c[k - 1][i - 1] - c5 * c[k][i - 1]) / c2;
        c[0][i] = -c1 * c5 * c[0][i - 1] / c2;
      }
      for (std::size_t k = order; k > 0; --k)
        c[k][j] = (c4 * c[k][j] - static_cast<double>(k) * c[k - 1][j]) / c3;
      c[0][j] = c4 * c[0][j] / c3;
    }
    c1 = c2;
  }
  return c;
}

}  // namespace

std::size_t HermiteFit::sample_intervals(std::size_t cells) { return std::max(least_intervals, 2 * cells); }

HermiteFit::HermiteFit(std::size_t cells) : cells_(cells), per_cell_(sample_intervals(cells) / cells) {
  const std::size_t last = sample_intervals(cells) - least_intervals;
  const auto step = static_cast<double>(per_cell_);
  for (std::size_t i = 0; i <= cells; ++i) {
    const std::size_t sample = i * per_cell_;
    Node node{};
    node.first = std::min(sample > width / 2 ? sample - width / 2 : 0, last);
    const auto weights = difference_weights(static_cast<double>(sample - node.first));
    for (std::size_t k = 0; k < width; ++k) {
      node.slope[k] = weights[1][k] * step;
      node.curvature[k] = weights[2][k] * step * step;
    }
    nodes_.push_back(node);
  }
}

void HermiteFit::operator()(const double* samples, std::size_t stride, double* result,
                            std::size_t result_stride) const {
  struct Data {
    double value, slope, curvature;
  };
  const auto at = [&](std::size_t i) {
    const Node& node = nodes_[i];
    Data d{samples[i * per_cell_ * stride], 0, 0};
    for (std::size_t k = 0; k < width; ++k) {
      const double f = samples[(node.first + k) * stride];
      d.slope += node.slope[k] * f;
      d.curvature += node.curvature[k] * f;
    }
    return d;
  };
  Data l = at(0);
  for (std::size_t i = 0; i < cells_; ++i) {
    const Data r = at(i + 1);
    const double d0 = r.value - (l.value + l.slope + 0.5 * l.curvature);
    const double d1 = r.slope - (l.slope + l.curvature);
    const double d2 = r.curvature - l.curvature;
    const std::array<double, 6> c = {l.value,
                                     l.slope,
                                     0.5 * l.curvature,
                                     10 * d0 - 4 * d1 + 0.5 * d2,
                                     -15 * d0 + 7 * d1 - d2,
                                     6 * d0 - 3 * d1 + 0.5 * d2};
    for (std::size_t k = 0; k < 6; ++k) result[(6 * i + k) * result_stride] = c[k];
    l = r;
  }
}

}  // namespace whipple::eos

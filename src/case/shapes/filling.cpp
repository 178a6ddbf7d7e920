// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/filling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/case/shapes/combination.hpp"
#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::cases {

Filling::Filling(const Box& box) : box_(box) {
  if (!((box.upper - box.lower).minCoeff() > 0.0)) {
    throw InputError("is empty: the lower corner is not below the upper one");
  }
}

void Filling::calibrate() {
  constexpr std::size_t points = 200000;
  // Additive recurrence in three dimensions, whose constants are powers of the root of x^4 = x + 1.
  constexpr double root = 1.2207440846057596;
  const Vector3 step(1.0 / root, 1.0 / (root * root), 1.0 / (root * root * root));
  std::vector<double> levels(points);
  parallel::for_each_uneven(points, [&](std::size_t i) {
    Vector3 part = Vector3::Constant(0.5) + static_cast<double>(i) * step;
    for (double& x : part) x -= std::floor(x);
    levels[i] = level(box_.lower + part.cwiseProduct(box_.upper - box_.lower));
  });
  const auto rank = static_cast<std::ptrdiff_t>(box_.density * static_cast<double>(points - 1));
  std::ranges::nth_element(levels, levels.begin() + rank);
  threshold_ = levels[static_cast<std::size_t>(rank)];
}

std::vector<std::string> Filling::account() const {
  return {fmt::format("relative density {:.4g} by counting, {:.4g} asked for",
                      counted_volume(*this) / (box_.upper - box_.lower).prod(), box_.density)};
}

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/filling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/case/shapes/combination.hpp"
#include "src/case/shapes/spread_points.hpp"
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
  std::vector<double> levels(points);
  parallel::for_each_uneven(points, [&](std::size_t i) {
    levels[i] = level(box_.lower + spread_point(i).cwiseProduct(box_.upper - box_.lower));
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

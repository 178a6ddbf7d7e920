// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "tests/verification/exact/result.hpp"

namespace whipple::verification::exact {

/// Greatest deviation of a figure from its exact value, at the coarse, middle and fine resolution of a
/// problem.
struct Bound {
  const char* problem;
  const char* figure;
  double exact;
  std::array<double, 3> deviation;  ///< `unbounded`: not held
};
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Least order of convergence of a figure between the coarse and middle, and the middle and fine resolution.
struct Order {
  const char* problem;
  const char* figure;
  std::array<double, 2> least;
};

/// Prints a result and holds its figures within the bounds of the problem.
/// @param resolution  0 coarse, 1 middle, 2 fine
inline void expect_within(const std::string& problem, const Result& result, std::span<const Bound> bounds,
                          std::size_t resolution) {
  print(problem, result);
  int held = 0;
  for (const Bound& bound : bounds) {
    if (bound.problem != problem || bound.deviation[resolution] == unbounded) continue;
    const auto figure = std::ranges::find(result.figures, bound.figure, &Figure::name);
    ASSERT_NE(figure, result.figures.end()) << bound.figure;
    const std::string where = problem + ", " + result.resolution + ": " + bound.figure;
    EXPECT_NEAR(figure->exact, bound.exact, 1e-3 * std::abs(bound.exact)) << where;
    EXPECT_NEAR(figure->value, figure->exact, bound.deviation[resolution]) << where;
    ++held;
  }
  EXPECT_GT(held, 0) << problem << " has no bounds at this resolution";
}

/// Prints the orders between two results and holds them above the bounds of the problem.
/// @param step  0 between coarse and middle, 1 between middle and fine
inline void expect_orders(const std::string& problem, const Result& coarse, const Result& fine,
                          std::span<const Order> orders, std::size_t step) {
  for (const Order& order : orders) {
    if (order.problem != problem) continue;
    const double value = order_of(coarse, fine, order.figure);
    std::printf("%s, %s to %s: order of %s %.2f\n", problem.c_str(), coarse.resolution.c_str(),
                fine.resolution.c_str(), order.figure, value);
    EXPECT_GE(value, order.least[step]) << problem << ": " << order.figure;
  }
}

/// Runs of one problem at two neighbouring resolutions, held within its bounds: `middle` and `fine` of the
/// long part, `coarse` and `middle` of the other.
template <class Run, class Resolution>
void expect_convergence(const std::string& problem, Run&& run, const std::array<Resolution, 3>& resolutions,
                        bool fine, std::span<const Bound> bounds, std::span<const Order> orders) {
  const std::size_t first = fine ? 1 : 0;
  const Result a = run(resolutions[first]), b = run(resolutions[first + 1]);
  if (!fine) expect_within(problem, a, bounds, 0);
  expect_within(problem, b, bounds, first + 1);
  expect_orders(problem, a, b, orders, first);
}

}  // namespace whipple::verification::exact

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>

#include "tests/verification/exact/result.hpp"

namespace whipple::verification::exact {

/// Prints a result and holds its figures within bounds.
inline void expect_within(const std::string& problem, const Result& result, std::span<const Bound> bounds) {
  print(problem, result);
  for (const Bound& bound : bounds) {
    const double value = result.at(bound.figure);
    EXPECT_GE(value, bound.least) << problem << ", " << result.resolution << ": " << bound.figure << ", exact "
                                  << bound.exact;
    EXPECT_LE(value, bound.greatest) << problem << ", " << result.resolution << ": " << bound.figure << ", exact "
                                     << bound.exact;
  }
}

/// Least order of convergence of a figure.
struct Order {
  const char* figure;
  double least;
};

/// Prints the orders between two results and holds them above bounds.
inline void expect_orders(const std::string& problem, const Result& coarse, const Result& fine,
                          std::span<const Order> orders) {
  for (const Order& order : orders) {
    const double value = order_of(coarse, fine, order.figure);
    std::printf("%s, %s to %s: order of %s %.2f\n", problem.c_str(), coarse.resolution.c_str(),
                fine.resolution.c_str(), order.figure, value);
    EXPECT_GE(value, order.least) << problem << ": " << order.figure;
  }
}

}  // namespace whipple::verification::exact

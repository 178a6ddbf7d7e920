// SPDX-License-Identifier: BSD-3-Clause
// Loops that take several items at a time give what one item after the other gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "src/core/base/marks.hpp"
#include "src/core/base/vector_math.hpp"

namespace whipple {
namespace {

TEST(FourVectors, AreTheirComponents) {
  std::array<double, 12> numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 10.0 * static_cast<double>(i) + 1.0;
  const Triple<Lanes> v = load_vectors(numbers.data());
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(v.x[k], numbers[3 * k]);
    EXPECT_EQ(v.y[k], numbers[3 * k + 1]);
    EXPECT_EQ(v.z[k], numbers[3 * k + 2]);
  }
}

TEST(RoughLog, IsTheLogarithmTo4em8) {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> exponent(-700.0, 700.0);
  double worst = 0.0;
  for (int i = 0; i < 100000; ++i) {
    // Everywhere, and close to 1 and to the ends of the range that x is reduced to.
    const double x = i % 2 == 0 ? std::exp(exponent(generator)) : std::exp(exponent(generator) / 700.0);
    worst = std::max(worst, std::abs(rough_log(x) - std::log(x)));
  }
  EXPECT_LT(worst, 4e-8);
  EXPECT_EQ(rough_log(1.0), 0.0);
  EXPECT_NEAR(rough_log(std::numeric_limits<double>::min()), std::log(std::numeric_limits<double>::min()),
              4e-8);
}

TEST(ArrayFunctions, AreExponentialAndLogarithmInEveryKernelSet) {
  std::mt19937_64 generator(9);
  std::uniform_real_distribution<double> uniform(-700.0, 700.0);
  std::vector<double> x(800);
  for (double& value : x) value = uniform(generator);
  const KernelSet widest = kernel_set();
  for (const KernelSet set : {KernelSet::plain, KernelSet::narrow, widest}) {
    kernel_set() = set;
    std::vector<double> raised = x;
    exponentials(raised.data(), raised.size());
    std::vector<double> back = raised;
    logarithms(back.data(), back.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(raised[i], std::exp(x[i]), 1e-15 * std::exp(x[i])) << x[i];
      EXPECT_NEAR(back[i], std::log(raised[i]), 1e-15 * std::abs(x[i])) << x[i];
    }
  }
  kernel_set() = widest;
}

TEST(Marks, AreFoundInTheirOrder) {
  std::mt19937 generator(3);
  for (const std::size_t n : {0, 1, 7, 8, 9, 64, 1000}) {
    for (const unsigned one_in : {1U, 3U, 40U}) {
      std::vector<std::uint8_t> marks(n);
      std::vector<std::size_t> expected, found;
      for (std::size_t i = 0; i < n; ++i) {
        marks[i] = generator() % one_in == 0 ? 1 : 0;
        if (marks[i] != 0) expected.push_back(i);
      }
      for_each_marked(marks, [&](std::size_t i) { found.push_back(i); });
      EXPECT_EQ(found, expected) << n;
      for (std::size_t i = 0; i + 4 <= n; ++i) {
        const bool none = marks[i] + marks[i + 1] + marks[i + 2] + marks[i + 3] == 0;
        EXPECT_EQ(none_of_four(marks, i), none) << n;
      }
    }
  }
}

}  // namespace
}  // namespace whipple

// SPDX-License-Identifier: BSD-3-Clause
// Numbers and registers under one vocabulary: lane by lane the same.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "src/core/base/vectors.hpp"

namespace whipple {
namespace {

constexpr std::array<double, 12> numbers = {1.5,   -2.25, 3.0, -0.1, 7.0,  0.3,
                                            -11.0, 5.5,   2.0, 9.75, -4.0, 0.7};

TEST(Registers, DoLaneByLaneWhatNumbersDo) {
  const auto a = load<Lanes>(&numbers[0]), b = load<Lanes>(&numbers[4]), c = load<Lanes>(&numbers[8]);
  const Lanes sum = multiply_add(a, b, c), less = minimum(a, b), more = maximum(a, b);
  for (std::size_t l = 0; l < 4; ++l) {
    const double x = load<double>(&numbers[l]), y = numbers[4 + l], z = numbers[8 + l];
    EXPECT_EQ(sum[l], multiply_add(x, y, z)) << l;
    EXPECT_EQ(less[l], minimum(x, y)) << l;
    EXPECT_EQ(more[l], maximum(x, y)) << l;
    EXPECT_EQ(lane(a, l)[(l + 1) % 4], x);
    EXPECT_EQ(broadcast<Lanes>(x)[l], broadcast<double>(x));
  }
  // Rounded once: the product alone would lose the last digit.
  const double unit = 1.0 + 0x1p-30;
  EXPECT_EQ(multiply_add(broadcast(unit), broadcast(unit), broadcast(-1.0))[2], 0x1p-29 + 0x1p-60);
  EXPECT_EQ(multiply_add(unit, unit, -1.0), 0x1p-29 + 0x1p-60);
}

/// Whatever is not smaller (larger), NaN and the other zero included, gives the second argument.
TEST(Registers, TreatNaNAndZerosAsNumbersDo) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Lanes a = {nan, 1.0, 0.0, -0.0}, b = {1.0, nan, -0.0, 0.0};
  const Lanes less = minimum(a, b), more = maximum(a, b);
  const auto same = [](double x, double y) {
    return std::isnan(x) ? std::isnan(y) : x == y && std::signbit(x) == std::signbit(y);
  };
  for (std::size_t l = 0; l < 4; ++l) {
    EXPECT_TRUE(same(minimum(a[l], b[l]), b[l])) << l;
    EXPECT_TRUE(same(maximum(a[l], b[l]), b[l])) << l;
    EXPECT_TRUE(same(less[l], b[l])) << l;
    EXPECT_TRUE(same(more[l], b[l])) << l;
  }
#if WHIPPLE_WIDE_KERNELS
  if (kernel_set() != KernelSet::wide) return;
  std::array<double, 8> wide_less, wide_more;
  Wide::run([&]() WHIPPLE_INLINE {
    store(wide_less.data(), minimum(join(a, a), join(b, b)));
    store(wide_more.data(), maximum(join(a, a), join(b, b)));
  });
  for (std::size_t l = 0; l < 8; ++l) {
    EXPECT_TRUE(same(wide_less[l], b[l % 4])) << l;
    EXPECT_TRUE(same(wide_more[l], b[l % 4])) << l;
  }
#endif
}

TEST(Registers, PartsOfARegisterLeaveTheRestAlone) {
  const Lanes two = load<Lanes>(&numbers[0], 2), three = first_lanes(load<Lanes>(&numbers[0]), 3);
  for (std::size_t l = 0; l < 4; ++l) {
    EXPECT_EQ(two[l], l < 2 ? numbers[l] : 0.0);
    EXPECT_EQ(three[l], l < 3 ? numbers[l] : 0.0);
  }
  std::array<double, 4> to = {1.0, 1.0, 1.0, 1.0};
  store(to.data(), two, 1);
  EXPECT_EQ(to, (std::array{1.5, 1.0, 1.0, 1.0}));
  EXPECT_TRUE(all_positive(broadcast(0.1)));
  EXPECT_FALSE(all_positive(Lanes{1.0, 1.0, 0.0, 1.0}));
  const auto columns =
      transposed({load<Lanes>(&numbers[0]), load<Lanes>(&numbers[4]), load<Lanes>(&numbers[8]), Lanes{}});
  for (std::size_t l = 0; l < 4; ++l) EXPECT_EQ(columns[l][1], numbers[4 + l]);
}

TEST(Registers, HoldVectors) {
  const Triple<double> a = {1.5, -2.25, 3.0}, b = {7.0, 0.3, -11.0}, expected = cross(a, b);
  const Lanes v = load_vector(&numbers[0]), w = load_vector(&numbers[4]), product = cross(v, w);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(product[i], component(expected, i), 1e-14);
    EXPECT_EQ(component(v, i)[3], component(a, i));
    EXPECT_EQ(unit_vector<Lanes>(1)[i], component(unit_vector<Triple<double>>(1), i));
  }
  EXPECT_EQ(product[3], 0.0);
  EXPECT_NEAR(dot(v, w)[3], dot(a, b), 1e-14);
  const Triple<Lanes> four = load_vectors(numbers.data());
  for (std::size_t l = 0; l < 4; ++l) EXPECT_EQ(four.y[l], numbers[3 * l + 1]);
}

}  // namespace
}  // namespace whipple

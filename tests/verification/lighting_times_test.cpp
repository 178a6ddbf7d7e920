// SPDX-License-Identifier: BSD-3-Clause
// Lighting times of programmed burn against the exact ones of Kenamond's problems (as in ExactPack, Los Alamos).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "src/case/build/lighting.hpp"

namespace whipple::verification {
namespace {

using cases::Arrival;
using cases::Detonation;
using cases::DetonationField;
using cases::DetonatorShape;

Detonation point(double x, double y, double delay = 0.0) {
  return {.position = Vector3(x, y, 0.0), .delay = delay, .body = {}};
}

/// The square of 20 by 20 around the origin.
DetonationField square(double cell, std::function<double(const Vector3&)> velocity) {
  const auto count = static_cast<std::size_t>(std::lround(20.0 / cell));
  return {Vector3(-10.0, -10.0, 0.0), {count, count, 1}, cell, std::move(velocity)};
}

// Kenamond's problem 1: straight lines from several detonators, whose delays count.
TEST(LightingTimes, AreExactInSight) {
  const Arrival arrival(square(0.5, [](const Vector3&) { return 2.0; }),
                        std::vector{point(0, 5), point(0, -5, 1.0)});
  for (const auto& [x, y] : {std::pair(0.0, 9.9), {7.3, -9.1}, {-2.0, -4.0}, {0.01, 0.01}}) {
    const double exact = std::min(std::hypot(x, y - 5) / 2, 1.0 + std::hypot(x, y + 5) / 2);
    EXPECT_NEAR(arrival.at(Vector3(x, y, 0), 2.0), exact, 1e-12) << x << " " << y;
  }
  // A detonator that another front passes before its delay ends is dead.
  const Arrival late(square(0.5, [](const Vector3&) { return 2.0; }),
                     std::vector{point(0, 5), point(0, 4, 3.0)});
  EXPECT_NEAR(late.at(Vector3(0, -5, 0), 2.0), 5.0, 1e-12);
}

TEST(LightingTimes, OfEveryDetonator) {
  const double D = 2.0;
  const auto at = [&](const Detonation& d, double x, double y) { return d.arrival(Vector3(x, y, 0), D); };
  const Detonation line{
      .shape = DetonatorShape::line, .position = Vector3(0, 0, 0), .end = Vector3(4, 0, 0), .body = {}};
  EXPECT_DOUBLE_EQ(at(line, 3, 1), 0.5);
  EXPECT_DOUBLE_EQ(at(line, 7, 4), 2.5);
  const Detonation plane{
      .shape = DetonatorShape::plane, .position = Vector3(0, 1, 0), .normal = Vector3(0, 3, 0), .body = {}};
  EXPECT_DOUBLE_EQ(at(plane, 9, 3), 1.0);
  EXPECT_DOUBLE_EQ(at(plane, 9, -1), 1.0);
  const Detonation sphere{.shape = DetonatorShape::sphere, .radius = 1.0, .body = {}};
  EXPECT_DOUBLE_EQ(at(sphere, 3, 4), 2.0);
  EXPECT_DOUBLE_EQ(at(sphere, 0.5, 0), 0.0);
  // A cord of 4 m/s: sin 30 deg = D/4, the front leaves it at 60 deg to the cord.
  const Detonation cord{
      .shape = DetonatorShape::cord, .end = Vector3(10, 0, 0), .velocity = 4.0, .delay = 1.0, .body = {}};
  EXPECT_DOUBLE_EQ(at(cord, 8, 0), 3.0);
  EXPECT_NEAR(at(cord, 8, 1), 1.0 + 2.0 + std::cos(std::numbers::pi / 6) / D, 1e-12);
  EXPECT_DOUBLE_EQ(at(cord, -2, 0), 2.0);
  EXPECT_DOUBLE_EQ(at(cord, 12, 0), 4.5);
}

/// Kenamond's problem 3: around an inert circle of radius 3, lit at (0, 5).
double around_circle(double x, double y, double D) {
  constexpr double R = 3.0, d = 5.0;
  const double r = std::hypot(x, y);
  const double theta = std::numbers::pi - std::acos(-y / r) - std::acos(R / r) - std::acos(R / d);
  if (theta <= 0.0) return std::hypot(x, y - d) / D;
  return (std::sqrt(d * d - R * R) + R * theta + std::sqrt(r * r - R * R)) / D;
}

/// Largest and mean error in the shadow, in seconds.
std::pair<double, double> shadow_error(double cell, double D) {
  const Arrival arrival(square(cell, [&](const Vector3& x) { return x.norm() < 3.0 ? 0.0 : D; }),
                        std::vector{point(0, 5)});
  double largest = 0.0, sum = 0.0, count = 0.0;
  for (double x = -9.9; x < 10; x += 0.37) {
    for (double y = -9.9; y < 10; y += 0.37) {
      if (std::hypot(x, y) < 3.0) continue;
      const double exact = around_circle(x, y, D), error = std::abs(arrival.at(Vector3(x, y, 0), D) - exact);
      const bool in_sight = exact <= std::hypot(x, y - 5) / D + 1e-9;
      if (in_sight && x * x + y * y > 12.0) {
        EXPECT_LT(error, 1e-12) << x << " " << y;
      }
      largest = std::max(largest, error);
      sum += in_sight ? 0.0 : error;
      count += in_sight ? 0.0 : 1.0;
    }
  }
  return {largest, sum / count};
}

TEST(LightingTimes, GoRoundAnInertCircle) {
  // Of first order, but not smoothly: the path bends at centres of cells, more or less far from the circle.
  constexpr double D = 2.0, h = 0.1;
  const auto [coarse, coarse_mean] = shadow_error(4 * h, D);
  const auto [fine, fine_mean] = shadow_error(h, D);
  EXPECT_LT(coarse, 1.5 * 4 * h / D);
  EXPECT_LT(fine, 1.5 * h / D);
  EXPECT_LT(fine_mean, 0.5 * coarse_mean);
  // The published values, (x, y) and t.
  EXPECT_NEAR(around_circle(4, -4, D), 5.023555, 1e-6);
  EXPECT_NEAR(around_circle(0, -5, D), 5.930503, 1e-6);
}

// Kenamond's problem 2: a fast circle of radius 3 in a slow explosive, five detonators with delays on the axis.
TEST(LightingTimes, OfTwoExplosives) {
  const auto arrivals = [](double cell) {
    const Arrival arrival(
        square(cell, [](const Vector3& x) { return x.norm() <= 3.0 ? 2.0 : 1.0; }),
        std::vector{point(0, 10, 2), point(0, 5, 1), point(0, 0), point(0, -5, 1), point(0, -10, 2)});
    double largest = 0.0;
    for (const auto& [x, y, t] : {std::tuple(0.0, 1.0, 0.5),
                                  {0.0, 2.9, 1.45},
                                  {6.0, 0.0, 4.5},
                                  {0.0, 4.0, 2.0},
                                  {0.0, 6.0, 2.0},
                                  {0.0, 7.5, 3.5},
                                  {0.0, 9.0, 3.0},
                                  {5.0, 5.0, 5.571068},
                                  {8.0, 8.0, 9.544004}}) {
      largest =
          std::max(largest, std::abs(arrival.at(Vector3(x, y, 0), std::hypot(x, y) <= 3.0 ? 2.0 : 1.0) - t));
    }
    return largest;
  };
  EXPECT_LT(arrivals(0.4), 0.4);
  EXPECT_LT(arrivals(0.1), 0.1);
}

// A disc of radius 25 in a cylinder, 20 from the detonator, of no thickness but a cell; three dimensions.
TEST(LightingTimes, GoRoundADisc) {
  constexpr double D = 7.98, cell = 1.0, a = 25.0, z1 = 20.0;
  const Arrival arrival({Vector3(0, 0, 0),
                         {41, 41, 61},
                         cell,
                         [](const Vector3& x) {
                           return std::hypot(x[0], x[1]) < a && x[2] > z1 && x[2] < z1 + 0.99 * cell ? 0.0
                                                                                                     : D;
                         }},
                        std::vector{Detonation{}});
  const auto exact = [](double r, double z) { return (std::hypot(a, z1) + std::hypot(r - a, z - z1)) / D; };
  EXPECT_NEAR(arrival.at(Vector3(0, 0, 60), D), exact(0, 60), 1.5 * cell / D);
  constexpr double x = 20 / std::numbers::sqrt2;
  EXPECT_NEAR(arrival.at(Vector3(x, x, 60), D), exact(20, 60), 1.5 * cell / D);
  EXPECT_NEAR(arrival.at(Vector3(40, 0, 30), D), std::hypot(40, 30) / D, 1e-12);
}

}  // namespace
}  // namespace whipple::verification

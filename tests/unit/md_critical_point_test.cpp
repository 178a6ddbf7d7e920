// SPDX-License-Identifier: BSD-3-Clause
// The critical point from densities of melt and vapour whose critical point is known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "md_fitting/protocols/critical_point.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Densities with the critical point 6000 K, 2000 kg/m^3.
std::vector<Saturation> fluid(double noise, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<Saturation> points;
  for (const double t : {4400.0, 4800.0, 5200.0, 5500.0}) {
    const double half = 3500.0 * std::pow(1.0 - t / 6000.0, 0.325);
    const double mean = 2000.0 + 0.3 * (6000.0 - t);
    points.push_back({t,
                      {mean + half + noise * normal(generator), noise},
                      {mean - half + noise * normal(generator), noise}});
  }
  return points;
}

TEST(CriticalPoint, IsRecoveredFromTheScalingLawAndTheDiameter) {
  const CriticalPoint point = estimate_critical_point(fluid(0.0, 1));
  EXPECT_NEAR(point.temperature.value, 6000.0, 1e-6);
  EXPECT_NEAR(point.density.value, 2000.0, 1e-6);
  EXPECT_EQ(point.temperature.error, 0.0);
}

// With noise the stated errors are the true ones: the normalised deviations have variance 1.
TEST(CriticalPoint, StatesHonestErrors) {
  double temperature = 0.0, density = 0.0;
  constexpr int trials = 500;
  for (int i = 0; i < trials; ++i) {
    const CriticalPoint point = estimate_critical_point(fluid(30.0, static_cast<std::uint64_t>(i)));
    temperature += std::pow((point.temperature.value - 6000.0) / point.temperature.error, 2) / trials;
    density += std::pow((point.density.value - 2000.0) / point.density.error, 2) / trials;
  }
  EXPECT_NEAR(temperature, 1.0, 0.25);
  EXPECT_NEAR(density, 1.0, 0.25);
}

TEST(CriticalPoint, RefusesDensitiesWithoutOne) {
  std::vector<Saturation> points = fluid(0.0, 1);
  EXPECT_THROW(estimate_critical_point(std::span(points).first(2)), StateError);
  std::swap(points[0].temperature, points[3].temperature);  // densities that part with rising temperature
  std::swap(points[1].temperature, points[2].temperature);
  EXPECT_THROW(estimate_critical_point(points), StateError);
  points = fluid(0.0, 1);
  std::swap(points[0].liquid_density, points[0].vapour_density);
  EXPECT_THROW(estimate_critical_point(points), StateError);
}

}  // namespace
}  // namespace whipple::md

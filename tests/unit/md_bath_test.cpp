// SPDX-License-Identifier: BSD-3-Clause
// Thermal averages of a crystal in a bath, on a crystal whose averages are known: harmonic vibrations whose
// energies wander as a Langevin bath makes them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "md_fitting/protocols/bath.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

constexpr double bath = 300.0;       // K
constexpr double cold = 5.0;         // the quantity in the static crystal
constexpr double per_kelvin = 0.01;  // its thermal part; exact mean: cold + per_kelvin bath
constexpr std::size_t sample_count = 600;
constexpr std::int64_t interval = 10;  // steps between samples

struct Series {
  std::vector<double> quantity;
  std::vector<double> temperature;
};

/// Vibrations with periods of 8 to 24 samples and energies that forget themselves within 20; the quantity
/// weighs their potential energies between 0.8 and 1.2, as a pressure weighs modes by their Grueneisen
/// coefficients.
Series vibrations(unsigned seed) {
  constexpr std::size_t modes = 60;
  constexpr double memory = 0.975;  // of an amplitude from one sample to the next
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  Series series{std::vector<double>(sample_count, cold), std::vector<double>(sample_count, 0.0)};
  for (std::size_t m = 0; m < modes; ++m) {
    const double share = static_cast<double>(m) / (modes - 1);
    const double frequency = 2.0 * std::numbers::pi / (8.0 + 16.0 * share);
    const double weight = 0.8 + 0.4 * share;
    double cosine = normal(generator);  // amplitudes of both phases: their squares have mean 1
    double sine = normal(generator);
    for (std::size_t i = 0; i < sample_count; ++i) {
      const double phase = frequency * static_cast<double>(i);
      const double position = cosine * std::cos(phase) + sine * std::sin(phase);
      const double velocity = sine * std::cos(phase) - cosine * std::sin(phase);
      series.quantity[i] += per_kelvin * bath * weight * position * position / modes;
      series.temperature[i] += bath * velocity * velocity / modes;
      const double noise = std::sqrt(1.0 - memory * memory);
      cosine = memory * cosine + noise * normal(generator);
      sine = memory * sine + noise * normal(generator);
    }
  }
  return series;
}

// The mean stays the right one, its error shrinks several times, and 200 runs scatter by what each states.
TEST(InBath, RemovesTheWanderingOfTemperatureAndStatesItsError) {
  constexpr int runs = 200;
  constexpr double exact = cold + per_kelvin * bath;
  double mean = 0.0;
  double squares = 0.0;
  double stated = 0.0;
  double stated_before = 0.0;
  for (unsigned seed = 0; seed < runs; ++seed) {
    const Series series = vibrations(seed);
    const Estimate estimate = series_mean(in_bath(series.quantity, cold, series.temperature, bath, interval));
    mean += estimate.value / runs;
    squares += (estimate.value - exact) * (estimate.value - exact) / runs;
    stated += estimate.error * estimate.error / runs;
    const double before = series_mean(series.quantity).error;
    stated_before += before * before / runs;
  }
  EXPECT_NEAR(mean, exact, 4.0 * std::sqrt(squares / runs));
  EXPECT_NEAR(std::sqrt(squares / stated), 1.0, 0.2);
  EXPECT_GT(std::sqrt(stated_before / stated), 3.0);
}

// What is exactly proportional to the temperature of each moment has no noise left but the square of its
// wandering.
TEST(InBath, LeavesNothingOfWhatFollowsTheTemperature) {
  Series series = vibrations(1);
  double mean = 0.0;
  for (std::size_t i = 0; i < sample_count; ++i) {
    series.quantity[i] = cold + per_kelvin * series.temperature[i];
    mean += series.temperature[i] / sample_count;
  }
  const double wandering = std::abs(mean - bath) / bath;
  ASSERT_GT(wandering, 1e-3);
  const double left = series_mean(in_bath(series.quantity, cold, series.temperature, bath, interval)).value -
                      (cold + per_kelvin * bath);
  EXPECT_LT(std::abs(left), 0.2 * per_kelvin * bath * wandering);
}

TEST(InBath, NeedsATemperatureForEachSample) {
  EXPECT_THROW(in_bath(std::vector<double>(64, 1.0), 0.0, std::vector<double>(63, 300.0), 300.0, 10),
               InternalError);
}

}  // namespace
}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
// The error of the mean of the mean of correlated data, where the naive formula is several times too
// small.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "md_fitting/protocols/statistics.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

constexpr double correlation = 0.9;  // x[i+1] = correlation x[i] + noise
constexpr std::size_t samples = 8192;

std::vector<double> autoregressive(unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> noise;
  std::vector<double> series(samples);
  double x = noise(generator) / std::sqrt(1 - correlation * correlation);
  for (double& value : series) value = x = correlation * x + noise(generator);
  return series;
}

// The mean of an AR(1) series with unit noise has the standard error 1/((1 - c) sqrt(n)) for long series.
TEST(SeriesMean, FindsTheErrorOfAnAutoregressiveSeries) {
  const double exact = 1.0 / ((1.0 - correlation) * std::sqrt(static_cast<double>(samples)));
  const double naive = exact * std::sqrt((1 - correlation) / (1 + correlation));
  double mean_error = 0.0;
  int within = 0;
  constexpr int realisations = 200;
  for (unsigned seed = 0; seed < realisations; ++seed) {
    const Estimate estimate = series_mean(autoregressive(seed));
    mean_error += estimate.error / realisations;
    if (std::abs(estimate.value) < 2.0 * estimate.error) ++within;
  }
  EXPECT_GT(mean_error, 0.95 * exact);
  EXPECT_LT(mean_error, 1.35 * exact);
  EXPECT_GT(mean_error, 3.5 * naive);
  // 95 % of normal means lie within two standard errors; 200 trials scatter by 1.5 %.
  EXPECT_GE(within, 184);
}

// The blocks that a bootstrap draws from have the mean of the series' end, and their scatter is the error.
TEST(BlockMeans, AreSixteenAndCarryTheError) {
  const std::vector<double> series = autoregressive(1);
  const std::vector<double> blocks = block_means(series);
  ASSERT_EQ(blocks.size(), 16u);
  double mean = 0.0;
  for (const double value : blocks) mean += value / 16.0;
  EXPECT_NEAR(mean, series_mean(series).value, 1e-12);  // a power of two of samples: nothing is dropped
  double squares = 0.0;
  for (const double value : blocks) squares += (value - mean) * (value - mean);
  EXPECT_NEAR(std::sqrt(squares / (16.0 * 15.0)) / series_mean(series).error, 1.0, 0.5);
  EXPECT_EQ(block_means(std::vector<double>(33, 2.0)), std::vector<double>(16, 2.0));
  EXPECT_THROW(block_means(std::vector<double>(15, 1.0)), InternalError);
}

// Short series: 200 samples are about ten times of correlation of 19 samples each. Without the correction for
// the series' own mean the error would be a fifth too small.
TEST(SeriesMean, IsHonestForShortSeries) {
  constexpr std::size_t length = 200;
  double squared_error = 0.0;
  double squared_mean = 0.0;
  int count = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<double> series = autoregressive(seed);
    for (std::size_t begin = 0; begin + length <= series.size(); begin += length) {
      const Estimate estimate = series_mean(std::span(series).subspan(begin, length));
      squared_error += estimate.error * estimate.error;
      squared_mean += estimate.value * estimate.value;
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squared_mean / squared_error), 1.0, 0.2) << count;
}

// A barostat's volume: an undamped oscillation of random phase on a slow correlated part ten times smaller.
// The largest error over block lengths would be that of blocks of half a period.
TEST(SeriesMean, DoesNotTakeAnOscillationForSlowMotion) {
  constexpr std::size_t length = 1000;
  double squared_error = 0.0;
  double squared_mean = 0.0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::vector<double> series = autoregressive(seed);
    series.resize(length);
    for (std::size_t i = 0; i < length; ++i) {
      series[i] +=
          23.0 * std::sqrt(2.0) * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / 18.0 + seed);
    }
    const Estimate estimate = series_mean(series);
    squared_error += estimate.error * estimate.error;
    squared_mean += estimate.value * estimate.value;
  }
  EXPECT_NEAR(std::sqrt(squared_mean / squared_error), 1.0, 0.35);
}

// Windows keep constants and straight lines, and lose what swings within them.
TEST(WindowAverages, KeepWhatIsSlow) {
  constexpr std::size_t length = 16;
  std::vector<double> line(100);
  std::vector<double> swing(100);
  for (std::size_t i = 0; i < line.size(); ++i) {
    line[i] = 3.0 + 0.5 * static_cast<double>(i);
    swing[i] = std::cos(2.0 * M_PI / 8.0 * static_cast<double>(i));
  }
  const std::vector<double> averages = window_averages(line, length);
  ASSERT_EQ(averages.size(), line.size() - length + 1);
  for (std::size_t i = 0; i < averages.size(); ++i) {
    EXPECT_NEAR(averages[i], 3.0 + 0.5 * (static_cast<double>(i) + 0.5 * (length - 1)), 1e-12);
  }
  for (const double average : window_averages(swing, length)) EXPECT_LT(std::abs(average), 0.02);
  EXPECT_EQ(window_averages(line, 1), line);
  EXPECT_THROW(window_averages(line, 0), InternalError);
  EXPECT_THROW(window_averages(line, 101), InternalError);
}

// Volume and energy under a barostat: vibrations of different phase and slowly changing amplitude with a
// common correlated part. Their products beat; the stated error must be that of the scatter over runs.
TEST(SeriesCovariance, IsHonestForVibrations) {
  constexpr std::size_t length = 1000;
  constexpr unsigned runs = 60;
  std::vector<Estimate> estimates;
  for (unsigned seed = 0; seed < runs; ++seed) {
    std::vector<double> first = autoregressive(3 * seed);
    std::vector<double> second = autoregressive(3 * seed + 1);
    const std::vector<double> amplitude = autoregressive(3 * seed + 2);
    first.resize(length), second.resize(length);
    for (std::size_t i = 0; i < length; ++i) {
      second[i] += first[i];
      const double phase = 2.0 * M_PI * static_cast<double>(i) / 18.0 + seed;
      first[i] += (8.0 + 2.0 * amplitude[i]) * std::cos(phase);
      second[i] += 4.0 * std::cos(phase + 0.3);
    }
    estimates.push_back(series_covariance(first, second));
  }
  double mean = 0.0;
  double stated = 0.0;
  for (const Estimate& run : estimates) mean += run.value / runs, stated += run.error * run.error / runs;
  double squares = 0.0;
  for (const Estimate& run : estimates) squares += (run.value - mean) * (run.value - mean);
  EXPECT_NEAR(mean, 1.0 / (1.0 - correlation * correlation) + 0.5 * 8.0 * 4.0 * std::cos(0.3), 1.0);
  EXPECT_NEAR(std::sqrt(squares / (runs - 1) / stated), 1.0, 0.35);
  EXPECT_THROW(series_covariance(std::vector<double>(20), std::vector<double>(21)), InternalError);
}

TEST(SeriesMean, RefusesWhatHasNoError) {
  EXPECT_THROW(series_mean(std::vector<double>(15, 1.0)), InternalError);
  std::vector<double> series(100, 1.0);
  EXPECT_EQ(series_mean(series).error, 0.0);
  series[50] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(series_mean(series), StateError);
}

TEST(ErrorCorrelation, SeesCommonNoise) {
  double independent = 0.0;
  double half = 0.0;  // of the noise is common
  for (unsigned seed = 0; seed < 50; ++seed) {
    const std::vector<double> a = autoregressive(2 * seed);
    const std::vector<double> b = autoregressive(2 * seed + 1);
    independent += error_correlation(a, b) / 50;
    std::vector<double> opposite = a;
    std::vector<double> mixed = a;
    for (std::size_t i = 0; i < a.size(); ++i) {
      opposite[i] = -3.0 * a[i];
      mixed[i] = a[i] + b[i];
    }
    EXPECT_NEAR(error_correlation(a, a), 1.0, 1e-9);
    EXPECT_NEAR(error_correlation(a, opposite), -1.0, 1e-9);
    half += error_correlation(a, mixed) / 50;
  }
  EXPECT_NEAR(independent, 0.0, 0.12);
  EXPECT_NEAR(half, std::sqrt(0.5), 0.06);
}

// Pressure and energy of a crystal share nearly all of their noise. An estimate from errors of their sum and
// difference, each with a noise of its own, leaves -1 ... 1 in a third of such series.
TEST(ErrorCorrelation, StaysBelowOneForSeriesThatShareNearlyAllNoise) {
  constexpr int realisations = 100;
  for (const double exact : {0.98, -0.98}) {
    double mean = 0.0;
    for (unsigned seed = 0; seed < realisations; ++seed) {
      const std::vector<double> common = autoregressive(2 * seed);
      const std::vector<double> own = autoregressive(2 * seed + 1);
      std::vector<double> other(common.size());
      for (std::size_t i = 0; i < common.size(); ++i) {
        other[i] = 1e3 + exact * common[i] + std::sqrt(1.0 - exact * exact) * own[i];
      }
      const double found = error_correlation(common, other);
      EXPECT_LT(std::abs(found), 0.9999) << seed;
      EXPECT_GT(std::abs(found), 0.9) << seed;
      mean += found / realisations;
    }
    EXPECT_NEAR(mean, exact, 0.004);
  }
  const std::vector<double> constant(samples, 2.0);
  EXPECT_EQ(error_correlation(constant, autoregressive(1)), 0.0);
  EXPECT_THROW(error_correlation(constant, std::vector<double>(100, 1.0)), InternalError);
}

}  // namespace
}  // namespace whipple::md

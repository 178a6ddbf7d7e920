// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

constexpr std::size_t least_blocks = 16;

/// Returns means of blocks of one length; leftover samples at the beginning are dropped.
std::vector<double> means_of_length(std::span<const double> series, std::size_t length) {
  const std::size_t blocks = series.size() / length;
  series = series.last(blocks * length);
  std::vector<double> means(blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto block = series.subspan(b * length, length);
    means[b] = std::accumulate(block.begin(), block.end(), 0.0) / static_cast<double>(length);
  }
  return means;
}

/// Returns the standard error of the mean from blocks of one length.
double error_with_blocks(std::span<const double> series, std::size_t length) {
  const std::vector<double> means = means_of_length(series, length);
  const std::size_t blocks = means.size();
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / static_cast<double>(blocks);
  double squares = 0.0;
  for (const double value : means) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(blocks * (blocks - 1)));
}

constexpr double window_in_times = 5.0;
/// Lower limit: an alternating series has a mean better than its samples suggest, but not without limit.
constexpr double least_time = 0.05;

/// Returns the mean product of deviations that are `lag` samples apart, over all of them.
double autocovariance(std::span<const double> deviations, std::size_t lag) {
  return std::inner_product(deviations.begin(), deviations.end() - static_cast<std::ptrdiff_t>(lag),
                            deviations.begin() + static_cast<std::ptrdiff_t>(lag), 0.0) /
         static_cast<double>(deviations.size());
}

/// Returns the period (samples) of a series whose variance is mostly that of a vibration, whose deviations change
/// sign after half a period; zero for other series. The first two sign changes of the autocovariance are half a
/// period apart.
double vibration_period(std::span<const double> deviations, double variance) {
  constexpr std::size_t longest_lag = 256;
  double former = variance;
  double least = 0.0;
  double first_change = 0.0;
  for (std::size_t lag = 1; lag <= std::min(longest_lag, deviations.size() / 4); ++lag) {
    const double present = autocovariance(deviations, lag);
    if ((former > 0.0) != (present > 0.0)) {
      const double change = static_cast<double>(lag) - present / (present - former);
      if (first_change > 0.0) return least < -0.5 * variance ? 2.0 * (change - first_change) : 0.0;
      first_change = change;
    }
    least = std::min(least, present);
    former = present;
  }
  return 0.0;
}

/// Returns a length of about 1/16 of a series that contains whole periods, so that a vibration cancels in the
/// means.
std::size_t length_of_whole_periods(std::size_t samples, double period) {
  const double periods = std::fmax(1.0, std::round(static_cast<double>(samples / least_blocks) / period));
  return static_cast<std::size_t>(std::lround(periods * period));
}

void require_blocks(std::span<const double> series) {
  if (series.size() >= least_blocks) return;
  throw InternalError(
      fmt::format("block averages need at least {} samples, not {}", least_blocks, series.size()));
}

}  // namespace

std::vector<double> block_means(std::span<const double> series) {
  require_blocks(series);
  std::vector<double> means = means_of_length(series, series.size() / least_blocks);
  means.erase(means.begin(), means.end() - static_cast<std::ptrdiff_t>(least_blocks));
  return means;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Estimate series_mean(std::span<const double> series) { return series_statistics(series).estimate; }

SeriesMean series_statistics(std::span<const double> series) {
  require_blocks(series);
  if (!std::all_of(series.begin(), series.end(), [](double value) { return std::isfinite(value); })) {
    throw StateError("a sample of the simulation is not finite");
  }
  const auto n = static_cast<double>(series.size());
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / n;
  std::vector<double> deviations(series.begin(), series.end());
  for (double& value : deviations) value -= mean;
  const double variance = autocovariance(deviations, 0);
  // A constant series, up to the rounding of its mean.
  if (variance <= 1e-28 * mean * mean) return {{mean, 0.0}, variance, 0.0};
  if (const double period = vibration_period(deviations, variance); period > 0.0) {
    return {{mean, error_with_blocks(series, length_of_whole_periods(series.size(), period))},
            variance,
            std::sqrt(2.0 * period / n)};
  }
  double time = 0.5;  // of correlation, in samples
  std::size_t lag = 1;
  for (const std::size_t longest = series.size() / 8; lag <= longest; ++lag) {
    time += autocovariance(deviations, lag) / variance;
    if (static_cast<double>(lag) >= window_in_times * time) break;
  }
  time = std::max(time, least_time);
  const double bias = 1.0 + (2.0 * static_cast<double>(lag) + 1.0) / n;
  return {{mean, std::sqrt(2.0 * time * bias * variance / (n - 1.0))}, variance, std::sqrt(4.0 * time / n)};
}

Estimate series_covariance(std::span<const double> first, std::span<const double> second) {
  if (first.size() != second.size()) throw InternalError("two series of different length have no covariance");
  const auto n = static_cast<double>(first.size());
  const double mean_first = series_mean(first).value;
  const double mean_second = series_mean(second).value;
  std::vector<double> deviations(first.begin(), first.end());
  for (double& value : deviations) value -= mean_first;
  std::vector<double> products(first.size());
  for (std::size_t i = 0; i < products.size(); ++i) products[i] = deviations[i] * (second[i] - mean_second);
  const double period = vibration_period(deviations, autocovariance(deviations, 0));
  if (period == 0.0) return series_mean(products);
  return {std::accumulate(products.begin(), products.end(), 0.0) / n,
          error_with_blocks(products, static_cast<std::size_t>(std::lround(period)))};
}

std::vector<double> window_averages(std::span<const double> series, std::size_t length) {
  if (length == 0 || length > series.size()) {
    throw InternalError(fmt::format("no window of {} samples in a series of {}", length, series.size()));
  }
  std::vector<double> weights(length);
  for (std::size_t i = 0; i < length; ++i) {
    const double s =
        std::sin(std::numbers::pi * static_cast<double>(i + 1) / static_cast<double>(length + 1));
    weights[i] = s * s;
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
  std::vector<double> averages(series.size() - length + 1);
  for (std::size_t i = 0; i < averages.size(); ++i) {
    averages[i] = std::inner_product(weights.begin(), weights.end(), series.data() + i, 0.0);
  }
  return averages;
}

double error_correlation(std::span<const double> first, std::span<const double> second) {
  if (first.size() != second.size())
    throw InternalError("two series of different length have no correlation");
  const std::vector<double> x = block_means(first);
  const std::vector<double> y = block_means(second);
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (std::size_t b = 0; b < x.size(); ++b) {
    xx += (x[b] - mean_x) * (x[b] - mean_x);
    yy += (y[b] - mean_y) * (y[b] - mean_y);
    xy += (x[b] - mean_x) * (y[b] - mean_y);
  }
  // A constant series, up to the rounding of its mean, has no error to be correlated.
  if (xx <= 1e-28 * n * mean_x * mean_x || yy <= 1e-28 * n * mean_y * mean_y) return 0.0;
  return std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);  // within rounding by the Cauchy-Schwarz inequality
}

}  // namespace whipple::md

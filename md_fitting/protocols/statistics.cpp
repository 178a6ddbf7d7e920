// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "src/base/error.hpp"

namespace whipple::md {
namespace {

constexpr std::size_t least_blocks = 16;

/// Means of blocks of one length; what is left over at the beginning is dropped.
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

/// Standard error of the mean from blocks of one length.
double error_with_blocks(std::span<const double> series, std::size_t length) {
  const std::vector<double> means = means_of_length(series, length);
  const std::size_t blocks = means.size();
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / static_cast<double>(blocks);
  double squares = 0.0;
  for (const double value : means) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(blocks * (blocks - 1)));
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

Estimate block_average(std::span<const double> series) {
  require_blocks(series);
  if (!std::all_of(series.begin(), series.end(), [](double value) { return std::isfinite(value); })) {
    throw StateError("a sample of the simulation is not finite");
  }
  Estimate estimate;
  estimate.value = std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
  for (std::size_t length = 1; series.size() / length >= least_blocks; length *= 2) {
    estimate.error = std::max(estimate.error, error_with_blocks(series, length));
  }
  return estimate;
}

double error_correlation(std::span<const double> first, std::span<const double> second) {
  const double first_error = block_average(first).error;
  const double second_error = block_average(second).error;
  if (first.size() != second.size())
    throw InternalError("two series of different length have no correlation");
  if (first_error == 0.0 || second_error == 0.0) return 0.0;
  // var(x + y) - var(x - y) = 4 cov(x, y), with both series in units of their errors.
  std::vector<double> sum(first.size());
  std::vector<double> difference(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    sum[i] = first[i] / first_error + second[i] / second_error;
    difference[i] = first[i] / first_error - second[i] / second_error;
  }
  const double plus = block_average(sum).error;
  const double minus = block_average(difference).error;
  return std::clamp(0.25 * (plus * plus - minus * minus), -1.0, 1.0);
}

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#include "src/sweep/sampling.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "src/core/base/random_bits.hpp"

namespace whipple::sweep {
namespace {

/// Holds the outputs at one x.
struct Group {
  double sum = 0.0, number = 0.0;
};

/// Returns the outputs by x, ascending.
std::map<double, Group> groups(std::span<const double> x, std::span<const double> y) {
  std::map<double, Group> of_value;
  for (std::size_t i = 0; i < x.size(); ++i) {
    of_value[x[i]].sum += y[i];
    of_value[x[i]].number += 1.0;
  }
  return of_value;
}

/// Returns E(E(y | x)^2) from the means of y at equal x.
double square_by_value(std::span<const double> x, std::span<const double> y) {
  double sum = 0.0;
  for (const auto& [value, group] : groups(x, y)) sum += group.sum * group.sum / group.number;
  return sum / static_cast<double>(x.size());
}

/// Returns E(E(y | x)^2) from products of outputs that follow each other in the order of x. Outputs of one x, which
/// differ by listed variables, count by their mean.
double square_by_rank(std::span<const double> x, std::span<const double> y) {
  std::vector<double> means;
  for (const auto& [value, group] : groups(x, y)) means.push_back(group.sum / group.number);
  if (means.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  return std::inner_product(means.begin(), means.end() - 1, means.begin() + 1, 0.0) /
         static_cast<double>(means.size() - 1);
}

}  // namespace

std::vector<std::vector<double>> random_samples(std::size_t count, std::size_t dimensions,
                                                std::uint64_t seed) {
  std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t d = 0; d < dimensions; ++d) points[i][d] = uniform(seed, i * dimensions + d);
  }
  return points;
}

std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t dimensions,
                                                 std::uint64_t seed) {
  std::vector<std::vector<double>> points = random_samples(count, dimensions, seed);
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::vector<std::size_t> stratum(count);
    std::iota(stratum.begin(), stratum.end(), std::size_t{0});
    const std::uint64_t seed_of_order = random_bits(seed + 1, d);
    for (std::size_t i = count; i > 1; --i)
      std::swap(stratum[i - 1], stratum[random_bits(seed_of_order, i) % i]);
    for (std::size_t i = 0; i < count; ++i)
      points[i][d] = (static_cast<double>(stratum[i]) + points[i][d]) / static_cast<double>(count);
  }
  return points;
}

double first_order_index(std::span<const double> x, std::span<const double> y, Design design) {
  const auto n = static_cast<double>(x.size());
  if (x.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  const double mean = std::accumulate(y.begin(), y.end(), 0.0) / n;
  std::vector<double> centred(y.begin(), y.end());  // of mean 0: E(E(y | x)^2) is then the variance sought
  for (double& value : centred) value -= mean;
  const double variance = std::inner_product(centred.begin(), centred.end(), centred.begin(), 0.0) / n;
  if (!(variance > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return (design == Design::listed ? square_by_value(x, centred) : square_by_rank(x, centred)) / variance;
}

}  // namespace whipple::sweep

// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/critical_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "md_fitting/data_set/points.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Exponent of the density difference of fluids; that of the three-dimensional Ising model is 0.326.
constexpr double scaling_exponent = 0.325;
constexpr std::size_t least_points = 3;

/// Returns intercept and slope of the weighted line through y(x).
std::array<double, 2> line(std::span<const double> x, std::span<const double> y, std::span<const double> w) {
  double s = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    s += w[i], sx += w[i] * x[i], sy += w[i] * y[i], sxx += w[i] * x[i] * x[i], sxy += w[i] * x[i] * y[i];
  }
  const double slope = (s * sxy - sx * sy) / (s * sxx - sx * sx);
  return {(sy - slope * sx) / s, slope};
}

}  // namespace

CriticalPoint estimate_critical_point(std::span<const Saturation> points) {
  const std::size_t n = points.size();
  if (n < least_points) {
    throw StateError(
        fmt::format("a critical point needs densities at {} temperatures, not {}", least_points, n));
  }
  std::vector<double> temperature(n), difference_weight(n), mean_weight(n);
  std::vector<double> densities(2 * n), errors(2 * n);  // liquid, vapour of each point
  const bool known_errors = std::all_of(points.begin(), points.end(), [](const Saturation& point) {
    return point.liquid_density.error > 0.0 && point.vapour_density.error > 0.0;
  });
  for (std::size_t i = 0; i < n; ++i) {
    const Saturation& point = points[i];
    temperature[i] = point.temperature;
    densities[2 * i] = point.liquid_density.value;
    densities[2 * i + 1] = point.vapour_density.value;
    errors[2 * i] = point.liquid_density.error;
    errors[2 * i + 1] = point.vapour_density.error;
    const double difference = point.liquid_density.value - point.vapour_density.value;
    if (!(difference > 0.0)) throw StateError("a melt is denser than its vapour");
    const double sigma = known_errors ? std::hypot(errors[2 * i], errors[2 * i + 1]) : 1.0;
    // Error of the difference to the power of 1/0.325, which is the straight line.
    const double stretched = sigma * std::pow(difference, 1.0 / scaling_exponent - 1.0) / scaling_exponent;
    difference_weight[i] = 1.0 / (stretched * stretched);
    mean_weight[i] = 1.0 / (sigma * sigma);
  }
  const auto solve = [&](const std::vector<double>& rho) {
    std::vector<double> stretched(n), mean(n);
    for (std::size_t i = 0; i < n; ++i) {
      stretched[i] = std::pow(std::fmax(rho[2 * i] - rho[2 * i + 1], 0.0), 1.0 / scaling_exponent);
      mean[i] = 0.5 * (rho[2 * i] + rho[2 * i + 1]);
    }
    const std::array<double, 2> law = line(temperature, stretched, difference_weight);
    const std::array<double, 2> diameter = line(temperature, mean, mean_weight);
    const double critical = -law[0] / law[1];
    return std::array<double, 3>{critical, diameter[0] + diameter[1] * critical, law[1]};
  };
  const std::array<double, 3> best = solve(densities);
  const double hottest = *std::max_element(temperature.begin(), temperature.end());
  if (!(best[2] < 0.0) || !(best[0] > hottest) || !std::isfinite(best[0])) {
    throw StateError("the densities of melt and vapour do not approach each other with rising temperature");
  }
  std::array<double, 2> variance{};
  for (std::size_t i = 0; i < densities.size(); ++i) {
    std::vector<double> moved = densities;
    moved[i] += errors[i];
    const std::array<double, 3> changed = solve(moved);
    for (std::size_t k = 0; k < 2; ++k) variance[k] += std::pow(changed[k] - best[k], 2);
  }
  return {{best[0], std::sqrt(variance[0])}, {best[1], std::sqrt(variance[1])}};
}

std::vector<Saturation> saturations(std::span<const PointRecord> points) {
  std::vector<Saturation> found;
  for (const LiquidVapourPoint& point : select_as<LiquidVapourPoint>(points)) {
    found.push_back({point.temperature, point.liquid_density, point.vapour_density});
  }
  return found;
}

}  // namespace whipple::md

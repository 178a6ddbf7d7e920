// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/free_energy_spline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr std::size_t degree = 5;
constexpr std::size_t active = degree + 1;  ///< functions that are not zero at a place
constexpr int left = 2;                     ///< of them, those with a centre before the interval of the place

/// Holds the active functions of one direction at a place: values and derivatives by the unit of the knots.
struct Basis {
  long first = 0;  ///< index of the centre of the first
  std::array<double, active> value{}, slope{}, curvature{};
};

/// Evaluates the uniform B-splines by their recursion over the degree.
Basis basis(double position, long last_interval) {
  const long interval = std::min(static_cast<long>(std::floor(position)), last_interval);
  const double t = position - static_cast<double>(interval);
  std::array<std::array<double, active>, active> of{};  // by degree
  of[0][0] = 1;
  for (std::size_t p = 1; p <= degree; ++p) {
    const auto order = static_cast<double>(p);
    for (std::size_t k = 0; k <= p; ++k) {
      const auto index = static_cast<double>(k);
      const double from_left = k > 0 ? (t + order - index) * of[p - 1][k - 1] : 0;
      const double from_right = k < p ? (index + 1 - t) * of[p - 1][k] : 0;
      of[p][k] = (from_left + from_right) / order;
    }
  }
  const auto difference = [](const std::array<double, active>& f, std::size_t k) {
    return (k > 0 ? f[k - 1] : 0) - f[k];
  };
  Basis b;
  b.first = interval - left;
  b.value = of[degree];
  std::array<double, active> slope{};  // of the functions of one degree less
  for (std::size_t k = 0; k < active; ++k) slope[k] = difference(of[degree - 2], k);
  for (std::size_t k = 0; k < active; ++k) {
    b.slope[k] = difference(of[degree - 1], k);
    b.curvature[k] = difference(slope, k);
  }
  return b;
}

/// Holds the functions of both directions with the derivatives by V and T.
struct Place {
  Basis volume, temperature;
  double v1, v2;  ///< of the position along ln V: d/dV, and d^2/dV^2 = v1^2 d^2 - v2 d
  double u1, u2;  ///< of the position along u, likewise with a plus
};

Place place(const FreeEnergyGrid& grid, double V, double T) {
  const double h = grid.volume_step(), h_u = grid.temperature_step();
  const double sum = T + grid.temperature;
  const auto intervals = static_cast<long>(grid.temperatures - degree);
  constexpr long everywhere = 1L << 30;
  Place p;
  p.volume = basis(std::clamp(std::log(V / grid.least_volume) / h, -1e6, 1e6), everywhere);
  p.temperature = basis(T / sum / h_u, intervals - 1);
  p.v1 = 1 / (h * V);
  p.v2 = 1 / (h * V * V);
  p.u1 = grid.temperature / (sum * sum * h_u);
  p.u2 = -2 * grid.temperature / (sum * sum * sum * h_u);
  return p;
}

}  // namespace

double FreeEnergyGrid::volume_step() const {
  return std::log(greatest_volume / least_volume) / static_cast<double>(volumes - 1);
}
double FreeEnergyGrid::temperature_step() const { return 1 / static_cast<double>(temperatures - degree); }
double FreeEnergyGrid::volume_centre(std::size_t i) const {
  return std::log(least_volume) + volume_step() * static_cast<double>(i);
}
double FreeEnergyGrid::temperature_centre(std::size_t k) const {
  return temperature_step() * (static_cast<double>(k) - left);
}

FreeEnergySpline::FreeEnergySpline(const FreeEnergyGrid& grid, std::vector<double> coefficients)
    : grid_(grid), coefficients_(std::move(coefficients)) {
  if (!(grid.least_volume > 0) || !(grid.greatest_volume > grid.least_volume) || !(grid.temperature > 0) ||
      grid.volumes < 2 || grid.temperatures < least_temperatures) {
    throw InputError(fmt::format(
        "correction of a free energy: volumes {:.6g} to {:.6g} m^3/kg in {} functions, temperature {:.6g} K "
        "in {}: the volumes must rise, with two functions or more, and {} or more of the temperature",
        grid.least_volume, grid.greatest_volume, grid.volumes, grid.temperature, grid.temperatures,
        least_temperatures));
  }
  if (coefficients_.size() != grid.size()) {
    throw InputError(fmt::format("correction of a free energy: {} coefficients, {} x {} are needed",
                                 coefficients_.size(), grid.volumes, grid.temperatures));
  }
}

FreeEnergyTerms FreeEnergySpline::operator()(double V, double T) const {
  const Place p = place(grid_, V, T);
  const auto volumes = static_cast<long>(grid_.volumes);
  // Sums over the temperatures of one row: of the values, and of the derivatives along u.
  FreeEnergyTerms local;  // by the units of the knots
  for (std::size_t i = 0; i < active; ++i) {
    const long row = std::clamp(p.volume.first + static_cast<long>(i), 0L, volumes - 1);
    const double* const c = &coefficients_[static_cast<std::size_t>(row) * grid_.temperatures +
                                           static_cast<std::size_t>(p.temperature.first + left)];
    double f = 0, f1 = 0, f2 = 0;
    for (std::size_t k = 0; k < active; ++k) {
      f += c[k] * p.temperature.value[k];
      f1 += c[k] * p.temperature.slope[k];
      f2 += c[k] * p.temperature.curvature[k];
    }
    local.F += f * p.volume.value[i];
    local.F_V += f * p.volume.slope[i];
    local.F_VV += f * p.volume.curvature[i];
    local.F_T += f1 * p.volume.value[i];
    local.F_VT += f1 * p.volume.slope[i];
    local.F_TT += f2 * p.volume.value[i];
  }
  return {local.F,
          p.v1 * local.F_V,
          p.u1 * local.F_T,
          p.v1 * p.v1 * local.F_VV - p.v2 * local.F_V,
          p.v1 * p.u1 * local.F_VT,
          p.u1 * p.u1 * local.F_TT + p.u2 * local.F_T};
}

void FreeEnergySpline::add_functional(const FreeEnergyGrid& grid, double V, double T,
                                      const FreeEnergyTerms& w, std::span<double> row) {
  const Place p = place(grid, V, T);
  for (std::size_t i = 0; i < active; ++i) {
    const long line =
        std::clamp(p.volume.first + static_cast<long>(i), 0L, static_cast<long>(grid.volumes) - 1);
    const double v = p.volume.value[i], v1 = p.v1 * p.volume.slope[i],
                 v2 = p.v1 * p.v1 * p.volume.curvature[i] - p.v2 * p.volume.slope[i];
    const std::size_t begin = static_cast<std::size_t>(line) * grid.temperatures +
                              static_cast<std::size_t>(p.temperature.first + left);
    for (std::size_t k = 0; k < active; ++k) {
      const double u = p.temperature.value[k], u1 = p.u1 * p.temperature.slope[k],
                   u2 = p.u1 * p.u1 * p.temperature.curvature[k] + p.u2 * p.temperature.slope[k];
      row[begin + k] += w.F * v * u + w.F_V * v1 * u + w.F_T * v * u1 + w.F_VV * v2 * u + w.F_VT * v1 * u1 +
                        w.F_TT * v * u2;
    }
  }
}

}  // namespace whipple::eos

// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/correction/correction_prior.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using eos::FreeEnergyGrid;

// Steps of ln V and numbers of functions of the temperature.
constexpr double common_step = 0.06, fluid_step = 0.12;
constexpr std::size_t temperatures = 10;
/// The grids begin at this fraction of the densest volume, and end at this multiple of the most dilute one.
constexpr double below = 0.75, beyond = 3.0;
constexpr double least_fluid_end = 4.0;  ///< V/V0 without dilute data
// Lengths over which the corrections change: ln V and u.
constexpr double common_length = 0.3, fluid_length = 0.5, temperature_length = 0.5;
// Standard deviations at f = 1 in units of C^2. A cold part of 0.003 C^2 over 0.3 of ln V is a pressure of 1 % of the
// bulk modulus.
constexpr double cold_size = 3e-3, thermal_size = 1e-3;
/// Functions over which the correction ends towards large volumes.
constexpr double taper = 4.0;

FreeEnergyGrid grid(double least, double greatest, double temperature, double step) {
  const double count = std::ceil(std::log(greatest / least) / step) + 1.0;
  return {least, greatest, temperature, static_cast<std::size_t>(std::max(count, 2.0)), temperatures};
}

/// Returns Matern's correlation for nu = 5/2.
double correlation(double distance, double length) {
  const double r = std::sqrt(5.0) * std::abs(distance) / length;
  return (1.0 + r + r * r / 3.0) * std::exp(-r);
}

/// Returns the covariance of the coefficients of a grid.
/// @param thermal  whether the part depends on the temperature
MatrixXd covariance(const FreeEnergyGrid& grid, double length, bool thermal, double size) {
  const auto count = static_cast<Index>(grid.size());
  MatrixXd K(count, count);
  const std::size_t n = grid.temperatures;
  const auto weight = [&](std::size_t i) {  // falls smoothly to zero at the last volume
    const double rest = std::min(1.0, static_cast<double>(grid.volumes - i) / taper);
    return rest * rest * (3.0 - 2.0 * rest);
  };
  for (std::size_t i = 0; i < grid.volumes; ++i) {
    for (std::size_t k = 0; k < grid.volumes; ++k) {
      const double along_volume = size * size * weight(i) * weight(k) *
                                  correlation(grid.volume_centre(i) - grid.volume_centre(k), length);
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) {
          const double along_temperature =
              thermal
                  ? correlation(grid.temperature_centre(a) - grid.temperature_centre(b), temperature_length)
                  : 1.0;
          K(static_cast<Index>(i * n + a), static_cast<Index>(k * n + b)) = along_volume * along_temperature;
        }
      }
    }
  }
  return K;
}

}  // namespace

CorrectionGrids correction_grids(const CorrectionData& data, const eos::GrayFreeEnergy& gray) {
  const double V0 = gray.constants().reference_specific_volume, T = gray.constants().melting_temperature;
  double least = V0, greatest = least_fluid_end * V0;
  for (const CorrectionDatum& datum : data.data) {
    for (const SurfaceTerm& term : datum.terms) {
      least = std::min(least, term.volume);
      greatest = std::max(greatest, beyond * term.volume);
    }
  }
  least *= below;
  return {grid(least, gray.join_volume(), T, common_step), grid(least, greatest, T, fluid_step)};
}

std::vector<CorrectionPart> correction_parts(const CorrectionGrids& grids, double energy) {
  const auto fluid = static_cast<Index>(grids.common.size());
  return {{"cold curve", 0, covariance(grids.common, common_length, false, cold_size * energy)},
          {"thermal energy", 0, covariance(grids.common, common_length, true, thermal_size * energy)},
          {"fluid, cold", fluid, covariance(grids.fluid, fluid_length, false, cold_size * energy)},
          {"fluid, thermal", fluid, covariance(grids.fluid, fluid_length, true, thermal_size * energy)}};
}

Eigen::RowVectorXd coefficient_row(const CorrectionGrids& grids, const std::vector<SurfaceTerm>& terms) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(grids.size());
  const std::span<double> all(row.data(), static_cast<std::size_t>(row.size()));
  for (const SurfaceTerm& term : terms) {
    eos::FreeEnergySpline::add_functional(grids.common, term.volume, term.temperature, term.weights,
                                          all.first(grids.common.size()));
    if (term.surface == PhaseSurface::solid) continue;
    eos::FreeEnergySpline::add_functional(grids.fluid, term.volume, term.temperature, term.weights,
                                          all.subspan(grids.common.size()));
  }
  return row;
}

}  // namespace whipple::fit

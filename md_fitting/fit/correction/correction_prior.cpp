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
constexpr double fluid_temperature = 3.0;  ///< T* of the fluid over that of the common part, T_m0, at least
/// The grids begin at this fraction of the densest volume, and end at this multiple of the most dilute one.
constexpr double below = 0.75, beyond = 3.0;
constexpr double least_fluid_end = 4.0;  ///< V/V0 without dilute data
/// V/V0: far enough from the solid for the common part to end without bending its pressure.
constexpr double common_end = 2.0;
// Lengths over which the corrections change: ln V and u.
constexpr double common_length = 0.3, fluid_length = 0.5, vapour_length = 1.2, temperature_length = 0.5;
/// Thermal parts fall to zero over these u.
constexpr double thermal_from = 0.6, thermal_to = 0.9;
// Standard deviations at f = 1 in units of C^2. A cold part of 0.003 C^2 over 0.3 of ln V is a pressure of 1 % of the
// bulk modulus; a twentieth of T_m times the entropy of melting is 0.0008 C^2 for copper.
constexpr double cold_size = 3e-3, thermal_size = 1e-3, melt_size = 5e-4, vapour_size = 3e-3;
/// The part of the expanded fluid rises over these V/V0, and falls as 1/V from there: as a second virial coefficient.
constexpr double expanded_from = 1.0, expanded_to = 1.6;
/// Standard deviation of ln f of the melt: melting of GRAY is right within a factor of two of these sizes.
constexpr double melt_spread = 1.5;
/// Of the energy of cohesion, in units of C^2.
constexpr double cohesion_size = 0.03;
/// Functions over which the correction ends towards large volumes.
constexpr double taper = 6.0;

FreeEnergyGrid grid(double least, double greatest, double temperature, double step) {
  const double count = std::ceil(std::log(greatest / least) / step) + 1.0;
  return {least, greatest, temperature, static_cast<std::size_t>(std::max(count, 2.0)), temperatures};
}

/// Returns Matern's correlation for nu = 5/2.
double correlation(double distance, double length) {
  const double r = std::sqrt(5.0) * std::abs(distance) / length;
  return (1.0 + r + r * r / 3.0) * std::exp(-r);
}

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Returns the weight of the thermal parts at u: they end where no solid is hot enough to have taught them.
double thermal_weight(double u) {
  return 1.0 - smooth_step((u - thermal_from) / (thermal_to - thermal_from));
}

/// Describes a part of the correction on a grid.
struct Part {
  double length = 0.0;   ///< of ln V
  bool thermal = false;  ///< depends on the temperature
  double size = 0.0;     ///< J/kg
  std::function<double(double log_volume)> weight = [](double) { return 1.0; };
  bool ends = true;  ///< at the last volume; otherwise it continues as a constant
};

/// Returns the covariance of the coefficients of a part.
MatrixXd covariance(const FreeEnergyGrid& grid, const Part& part) {
  const auto count = static_cast<Index>(grid.size());
  MatrixXd K(count, count);
  const std::size_t n = grid.temperatures;
  const auto weight = [&](std::size_t i) {  // falls smoothly to zero at the last volume
    return part.size * part.weight(grid.volume_centre(i)) *
           (part.ends ? smooth_step(static_cast<double>(grid.volumes - 1 - i) / taper) : 1.0);
  };
  for (std::size_t i = 0; i < grid.volumes; ++i) {
    for (std::size_t k = 0; k < grid.volumes; ++k) {
      const double along_volume =
          weight(i) * weight(k) * correlation(grid.volume_centre(i) - grid.volume_centre(k), part.length);
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) {
          const double along_temperature =
              part.thermal
                  ? thermal_weight(grid.temperature_centre(a)) * thermal_weight(grid.temperature_centre(b)) *
                        correlation(grid.temperature_centre(a) - grid.temperature_centre(b),
                                    temperature_length)
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
  double least = V0, greatest = least_fluid_end * V0, hottest = 0.0;
  for (const CorrectionDatum& datum : data.data) {
    for (const SurfaceTerm& term : datum.terms) {
      least = std::min(least, term.volume);
      greatest = std::max(greatest, beyond * term.volume);
      if (term.surface == PhaseSurface::fluid) hottest = std::max(hottest, term.temperature);
    }
  }
  least *= below;
  // The thermal parts of the fluid do not end before its hottest datum.
  const double to_hottest = hottest * (1.0 - thermal_from) / thermal_from;
  return {grid(least, common_end * V0, T, common_step),
          grid(least, greatest, std::max(fluid_temperature * T, to_hottest), fluid_step)};
}

std::vector<CorrectionPart> correction_parts(const CorrectionGrids& grids, double energy,
                                             double reference_volume) {
  const auto fluid = static_cast<Index>(grids.common.size());
  const auto expanded = [reference_volume](double log_volume) {
    const double x = log_volume - std::log(expanded_from * reference_volume);
    const double width = std::log(expanded_to / expanded_from);
    return smooth_step(x / width) * std::exp(-std::max(x - width, 0.0));
  };
  // What the energy of cohesion differs, with an attraction that ends where the fluid is no longer expanded.
  const auto cohesion = [reference_volume](double log_volume) {
    const double free = 1.0 - std::min(1.0, expanded_to * reference_volume * std::exp(-log_volume));
    return free * free;
  };
  constexpr double everywhere = 1e3;  // a length: one function with one unknown size
  const auto part = [&](double length, bool thermal, double size) {
    return Part{.length = length, .thermal = thermal, .size = size * energy};
  };
  const auto dense = [reference_volume](double log_volume) {
    const double x = log_volume - std::log(expanded_from * reference_volume);
    return 1.0 - smooth_step(x / std::log(expanded_to / expanded_from));
  };
  const auto of_melt = [&](bool thermal) {
    return Part{.length = fluid_length, .thermal = thermal, .size = melt_size * energy, .weight = dense};
  };
  const auto of_vapour = [&](bool thermal) {
    return Part{
        .length = vapour_length, .thermal = thermal, .size = vapour_size * energy, .weight = expanded};
  };
  const Part of_cohesion{
      .length = everywhere, .size = cohesion_size * energy, .weight = cohesion, .ends = false};
  return {{"cold curve", 0, covariance(grids.common, part(common_length, false, cold_size))},
          {"thermal energy", 0, covariance(grids.common, part(common_length, true, thermal_size))},
          {"melt, cold", fluid, covariance(grids.fluid, of_melt(false)), melt_spread},
          {"melt, thermal", fluid, covariance(grids.fluid, of_melt(true)), melt_spread},
          {"cohesion", fluid, covariance(grids.fluid, of_cohesion)},
          {"expanded, cold", fluid, covariance(grids.fluid, of_vapour(false))},
          {"expanded, thermal", fluid, covariance(grids.fluid, of_vapour(true))}};
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

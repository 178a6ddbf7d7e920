// SPDX-License-Identifier: BSD-3-Clause
#include "eos/table/sesame_data.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double thin_ratio = 1.25, middle_ratio = 1.01, dense_ratio = 1.05, temperature_ratio = 1.05;
constexpr double default_thinness = 1e-4;     ///< minimum density over the reference density
constexpr double default_compression = 10;    ///< maximum density over the reference density
constexpr double below_the_limit = 1 - 1e-9;  ///< a model whose pressure has a pole ends below its limit
constexpr double coldest_saturation = 100.0;  ///< Pa: colder rows of the dome are omitted
constexpr double least_rise = 1e-6;           ///< of the energy from one temperature to the next, minimum

/// Extends a geometric sequence from its last point up to `end`, which is the last.
void extend(std::vector<double>& points, double end, double greatest_ratio) {
  const double begin = points.back();
  if (!(end > begin)) return;
  const int steps = static_cast<int>(std::ceil(std::log(end / begin) / std::log(greatest_ratio)));
  for (int i = 1; i < steps; ++i)
    points.push_back(begin * std::pow(end / begin, static_cast<double>(i) / steps));
  points.push_back(end);
}

/// Returns an axis; the reference point is on the grid if it is within the range.
std::vector<double> axis(double begin, double end, const std::vector<std::pair<double, double>>& pieces) {
  std::vector<double> points = {begin};
  for (const auto& [to, ratio] : pieces) extend(points, std::min(to, end), ratio);
  return points;
}

SesameVaporisation vaporisation_of(const VapourDome& dome) {
  SesameVaporisation v;
  const auto helmholtz = [](const Saturation& s, double energy, double entropy) {
    return energy - s.temperature * entropy;
  };
  for (const Saturation& s : dome.rows()) {
    if (s.pressure < coldest_saturation) continue;
    v.pressure.push_back(s.pressure);
    v.temperature.push_back(s.temperature);
    v.vapour_density.push_back(1 / s.vapour_volume);
    v.liquid_density.push_back(1 / s.liquid_volume);
    v.vapour_energy.push_back(s.vapour_energy);
    v.liquid_energy.push_back(s.liquid_energy);
    v.vapour_helmholtz.push_back(helmholtz(s, s.vapour_energy, s.vapour_entropy));
    v.liquid_helmholtz.push_back(helmholtz(s, s.liquid_energy, s.liquid_entropy));
  }
  return v;
}

}  // namespace

EnergyRepair raise_energies(SesameGrid& grid) {
  constexpr double least_heat_capacity = 1e-3;  // of the mean one
  const std::size_t nr = grid.density.size(), nt = grid.temperature.size();
  EnergyRepair repair;
  repair.steps = nr * (nt - 1);
  for (std::size_t i = 0; i < nr; ++i) {
    const double range = grid.temperature.back() - grid.temperature.front();
    const double mean = (grid.energy[(nt - 1) * nr + i] - grid.energy[i]) / range;
    if (!(mean > 0)) continue;  // rejected by the reader
    for (std::size_t j = 1; j < nt; ++j) {
      const double low = grid.energy[(j - 1) * nr + i];
      double& high = grid.energy[j * nr + i];
      if (high > low) continue;
      // An increase below the digits of the energy does not count.
      const double least =
          std::max(least_heat_capacity * mean * (grid.temperature[j] - grid.temperature[j - 1]),
                   1e-14 * std::abs(low));
      const double raise = low + least - high;
      high = low + least;
      ++repair.raised;
      if (raise / mean / grid.temperature[j] > repair.fraction) {
        repair.largest = raise / mean;
        repair.fraction = raise / mean / grid.temperature[j];
        repair.density = grid.density[i];
        repair.temperature = grid.temperature[j];
      }
    }
  }
  return repair;
}

SesameMaterial sesame_of(const EquationOfState& eos, const SesameRequest& request) {
  if (eos.initial_distension() != 1.0) {
    throw InputError(
        "SESAME table: the state of porous material depends on its history, which a table of density and "
        "temperature cannot represent");
  }
  const double rho0 = eos.reference_density(), T0 = eos.reference_temperature();
  const double thinnest = request.minimum_density > 0 ? request.minimum_density : default_thinness * rho0;
  const double densest = request.maximum_density > 0
                             ? request.maximum_density
                             : std::min(below_the_limit * eos.maximum_density(), default_compression * rho0);
  const double coldest = request.least_temperature, hottest = request.greatest_temperature;
  if (!(thinnest > 0 && thinnest < densest) || !(coldest > 0 && coldest < hottest)) {
    throw InputError(
        fmt::format("SESAME table: densities {:.6g} to {:.6g} kg/m^3, temperatures {:.6g} to "
                    "{:.6g} K: expected positive values that rise",
                    thinnest, densest, coldest, hottest));
  }
  SesameMaterial result;
  result.reference_density = rho0;
  const State reference = eos.state_at_temperature(rho0, T0);
  result.bulk_modulus = std::isfinite(reference.isothermal_bulk_modulus) ? reference.isothermal_bulk_modulus
                                                                         : reference.isentropic_bulk_modulus;
  SesameGrid& grid = result.total;
  grid.density = axis(
      thinnest, densest,
      {{0.5 * rho0, thin_ratio}, {rho0, middle_ratio}, {2 * rho0, middle_ratio}, {densest, dense_ratio}});
  grid.temperature = axis(coldest, hottest, {{T0, temperature_ratio}, {hottest, temperature_ratio}});
  const bool complete = std::isfinite(reference.helmholtz_energy);
  for (const double T : grid.temperature) {
    for (const double rho : grid.density) {
      const State s = eos.state_at_temperature(rho, T);
      grid.pressure.push_back(s.pressure);
      // A temperature may have two energies where stretched metal melts; readers require an increasing one.
      double energy = s.specific_internal_energy;
      if (grid.energy.size() >= grid.density.size()) {
        const double colder = grid.energy[grid.energy.size() - grid.density.size()];
        energy = std::max(energy, colder + least_rise * std::abs(colder));
      }
      grid.energy.push_back(energy);
      if (complete) grid.helmholtz.push_back(s.helmholtz_energy);
    }
  }
  if (eos.vapour_dome() != nullptr) result.vaporisation = vaporisation_of(*eos.vapour_dome());
  return result;
}

}  // namespace whipple::eos

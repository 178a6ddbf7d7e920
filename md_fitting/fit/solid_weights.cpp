// SPDX-License-Identifier: BSD-3-Clause
// Weights of SolidProblem: covariances of its residuals (docs/theory/fit.md, sections 2 and 3).
#include <cmath>

#include "md_fitting/fit/discrepancy.hpp"
#include "md_fitting/fit/laws.hpp"
#include "md_fitting/fit/solid_problem.hpp"

namespace whipple::fit {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;

double square(double value) { return value * value; }
}  // namespace

void SolidProblem::weigh_noise(MatrixXd& statistical) const {
  Index row = 0;
  const auto weight = [&](double variance) {
    statistical(row, row) = variance;
    ++row;
  };
  weight(square(observations_.reference_volume.error));
  for (const HugoniotState& state : window_) {
    // V is exact; Us and up are both proportional to P^(1/2): d(Us - S up) = (Us - S up) dP/(2P).
    const auto [us, up] = velocities(state, start_.gray.reference_specific_volume);
    weight(
        square((us - start_.gray.hugoniot_slope * up) * state.pressure.error / (2.0 * state.pressure.value)));
  }
  if (model_.isotherm) {
    for (const IsothermState& state : observations_.isotherm) weight(square(state.pressure.error));
  }
  for (const Isochore& isochore : observations_.isochores) {
    const double k = gamma(start_.gray, isochore.volume) / isochore.volume;
    for (const ThermalState& state : isochore.states) {
      const double noise = square(state.energy.error);
      const double common = state.correlation * state.pressure.error * state.energy.error;
      // The residual of P contains -gamma E/V: the noise of E is common to both rows.
      statistical(row, row) = square(state.pressure.error) + k * k * noise - 2.0 * k * common;
      statistical(row + 1, row + 1) = noise;
      statistical(row, row + 1) = statistical(row + 1, row) = common - k * noise;
      row += 2;
    }
  }
  for (const MeltingPoint* point : melting_) {
    const double v = point->solid_volume.value;
    const double step = 1e-4 * v;
    const double slope =
        (melting_temperature(start_.gray, v + step) - melting_temperature(start_.gray, v - step)) /
        (2.0 * step);
    weight(square(point->temperature.error) + square(slope * point->solid_volume.error));
  }
  for (const MeltingPoint* point : fusion_) weight(square(point->latent_heat->error));
}

void SolidProblem::weigh_model(MatrixXd& model) const {
  const ModelErrors& errors = settings_.model_errors;
  const bool correlated = settings_.structure == ErrorStructure::correlated;
  const double v0 = start_.gray.reference_specific_volume;
  /// Adds a discrepancy along a curve: its size at each state, and the positions of the states.
  const auto along = [&](Index begin, const std::vector<double>& size, const std::vector<double>& place,
                         double length) {
    const Discrepancy deviation{size, [&](std::size_t i, std::size_t k) {
                                  if (i == k) return 1.0;
                                  return correlated ? matern(place[i] - place[k], length) : 0.0;
                                }};
    add_discrepancy(deviation, rows_from(begin, size.size()), model);
    return begin + static_cast<Index>(size.size());
  };

  Index row = 0;
  model(row, row) = square(scale_.of(DataKind::volume) * errors.zero_pressure_volume *
                           observations_.reference_volume.value);
  ++row;

  std::vector<double> size, place;
  for (const HugoniotState& state : window_) {
    const auto [us, up] = velocities(state, v0);
    size.push_back(scale_.of(DataKind::shock) * errors.shock_velocity * us);
    place.push_back(up);
  }
  row = along(row, size, place, settings_.lengths.particle_velocity);

  if (model_.isotherm) {
    size.clear(), place.clear();
    for (const IsothermState& state : observations_.isotherm) {
      size.push_back(scale_.of(DataKind::isotherm) *
                     std::hypot(errors.isotherm_pressure * state.pressure.value,
                                errors.isotherm_volume * start_.bulk_modulus));
      place.push_back(state.volume / v0);
    }
    row = along(row, size, place, settings_.lengths.volume_ratio);
  }

  weigh_isochores(row, model);
  for (const Isochore& isochore : observations_.isochores)
    row += 2 * static_cast<Index>(isochore.states.size());

  size.clear(), place.clear();
  for (const MeltingPoint* point : melting_) {
    size.push_back(scale_.of(DataKind::melting) * errors.melting_temperature * point->temperature.value);
    place.push_back(point->solid_volume.value / v0);
  }
  row = along(row, size, place, settings_.lengths.volume_ratio);

  size.clear(), place.clear();
  for (const MeltingPoint* point : fusion_) {
    size.push_back(scale_.of(DataKind::fusion) * errors.latent_heat * point->latent_heat->value);
    place.push_back(point->solid_volume.value / v0);
  }
  along(row, size, place, settings_.lengths.volume_ratio);
}

/// Adds two discrepancies of the pressure and two of the energy: of gamma and the anharmonic coefficient as
/// functions of V, and of the thermal pressure and energy as functions of V and T.
void SolidProblem::weigh_isochores(Index begin, MatrixXd& model) const {
  const ModelErrors& errors = settings_.model_errors;
  const CorrelationLengths& lengths = settings_.lengths;
  const bool correlated = settings_.structure == ErrorStructure::correlated;
  const double scale = scale_.of(DataKind::isochore);
  std::vector<double> volume, temperature;
  std::vector<double> gruneisen, thermal_pressure, anharmonic, energy;
  for (const Isochore& isochore : observations_.isochores) {
    const double k = gamma(start_.gray, isochore.volume) / isochore.volume;
    const ThermalState& cold = isochore.states.front();
    for (const ThermalState& state : isochore.states) {
      const double heat = state.energy.value - cold.energy.value;
      volume.push_back(isochore.volume / start_.gray.reference_specific_volume);
      temperature.push_back(state.temperature);
      gruneisen.push_back(scale * errors.gruneisen * k * heat);
      thermal_pressure.push_back(scale * errors.thermal_pressure * k * heat);
      anharmonic.push_back(scale * errors.anharmonic *
                           (square(state.temperature) - square(cold.temperature)) /
                           (2.0 * observations_.molar_mass));
      energy.push_back(scale * errors.energy * heat);
    }
  }
  const auto over_volume = [&](std::size_t i, std::size_t k) {
    if (correlated) return matern(volume[i] - volume[k], lengths.volume_ratio);
    return volume[i] == volume[k] ? 1.0 : 0.0;
  };
  const auto over_both = [&](std::size_t i, std::size_t k) {
    if (i == k) return 1.0;
    if (!correlated) return 0.0;
    return over_volume(i, k) * matern(temperature[i] - temperature[k], lengths.temperature);
  };
  const std::vector<Index> pressures = rows_from(begin, volume.size(), 2);
  const std::vector<Index> energies = rows_from(begin + 1, volume.size(), 2);
  add_discrepancy({gruneisen, over_volume}, pressures, model);
  add_discrepancy({thermal_pressure, over_both}, pressures, model);
  add_discrepancy({anharmonic, over_volume}, energies, model);
  add_discrepancy({energy, over_both}, energies, model);
}

}  // namespace whipple::fit

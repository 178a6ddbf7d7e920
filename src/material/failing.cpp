// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "src/material/chunk.hpp"

namespace whipple::material {
namespace {

constexpr double greatest_void_step = 0.1;  ///< |dV/V| of matter beside its void in one step

failure::Components<const double> view(const Chunk& chunk, const SymmetricLanes& lanes) {
  failure::Components<const double> components;
  for (std::size_t j = 0; j < 6; ++j) components.lane[j] = std::span(lanes[j].data(), chunk.size);
  return components;
}

/// Porous matter (eq. 20 to 22): the flow stress is that of the end of the step without voids.
void grow_voids(Step& step, Chunk& chunk, std::span<const double> bulk_modulus,
                std::span<const double> factor, std::span<double> damage, std::span<std::uint8_t> failed) {
  MaterialPoints& points = step.points;
  const double dt = step.settings.time_step;
  Lanes rate, flow, equivalent, before, volume, void_volume;
  for (std::size_t k = 0; k < chunk.size; ++k) rate[k] = chunk.increment[k] / dt;
  step.material.strength->flow_stress(chunk.strength_state(), chunk.view(rate), chunk.view(flow));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    flow[k] *= 1.0 - chunk.melted[k];
    before[k] = equivalent[k] = std::sqrt(1.5 * tensor(chunk.motion.deviator, k).squared_norm());
    volume[k] = points.volume[chunk.index[k]];
    void_volume[k] = points.void_volume[chunk.index[k]];
  }
  step.material.void_growth->grow_voids(
      {dt, bulk_modulus, chunk.view(chunk.motion.modulus), chunk.view(flow), chunk.view(chunk.motion.trial),
       factor, chunk.view(equivalent), chunk.view(chunk.acting_pressure), chunk.view(chunk.increment),
       chunk.view(chunk.plastic_strain), chunk.view(volume), chunk.view(void_volume)},
      damage, failed);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    if (equivalent[k] != before[k] && before[k] > 0.0) {
      scale(chunk.motion.deviator, k, equivalent[k] / before[k]);
    }
    points.volume[chunk.index[k]] = volume[k];
    points.void_volume[chunk.index[k]] = void_volume[k];
  }
}

/// Pressure of a point with cracks or voids and the division of its volume into matter and void: the share
/// `opening` of what exceeds the volume of zero pressure is void (eq. 12, 13, 18).
/// @param modulus  rho c^2 (Pa), bounded from below
/// @returns the pressure that acts
double share_volume(double pressure, double modulus, double opening, double& volume, double& void_volume) {
  const double total = volume + void_volume;
  const double relaxed =
      volume + std::clamp(pressure / modulus, -greatest_void_step, greatest_void_step) * volume;
  const double excess = total - relaxed;
  if (excess > 0.0) {  // tension opens the void, pressure lets the matter grow into it
    const double matter = opening == 1.0 ? relaxed : total - opening * excess;
    const double acting = pressure + modulus * (volume - matter) / volume;
    volume = matter;
    void_volume = total - matter;
    return opening == 1.0 ? 0.0 : std::min(acting, 0.0);
  }
  const double acting = pressure - modulus * void_volume / volume;
  volume = total;
  void_volume = 0.0;
  return std::max(acting, 0.0);
}

}  // namespace

void apply_failure(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  std::copy_n(chunk.pressure.data(), chunk.size, chunk.acting_pressure.data());
  if (step.material.failure.empty()) return;
  Lanes factor, damage, volume, bulk_modulus;
  std::array<std::uint8_t, chunk_size> failed;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    factor[k] = points.failure_threshold_factor[i];
    damage[k] = points.damage[i];
    failed[k] = points.failed[i];
    volume[k] = points.volume[i] + points.void_volume[i];
    bulk_modulus[k] = chunk.density[k] * chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k];
  }
  if (step.material.void_growth != nullptr) {
    grow_voids(step, chunk, chunk.view(bulk_modulus), chunk.view(factor), chunk.view(damage),
               chunk.view(failed));
  }
  const failure::State state = {.time_step = step.settings.time_step,
                                .pressure = chunk.view(chunk.acting_pressure),
                                .temperature = chunk.view(chunk.temperature),
                                .density = chunk.view(chunk.density),
                                .bulk_modulus = chunk.view(bulk_modulus),
                                .shear_modulus = chunk.view(chunk.solid_modulus),
                                .volume = chunk.view(volume),
                                .plastic_strain = chunk.view(chunk.plastic_strain),
                                .plastic_increment = chunk.view(chunk.increment),
                                .melted_fraction = chunk.view(chunk.melted),
                                .threshold_factor = chunk.view(factor),
                                .deviator = view(chunk, chunk.motion.deviator),
                                .strain = view(chunk, chunk.strain)};
  for (const auto& criterion : step.material.failure) {
    criterion->mark(state, chunk.view(damage), chunk.view(failed));
  }
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    points.damage[i] = damage[k];
    if (failed[k] == points.failed[i]) continue;
    points.failed[i] = failed[k];
    ++step.report.failed[failed[k]];
  }
}

void finish(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  const double least_sound_speed = least_sound_speed_ratio * step.material.reference.sound_speed;
  const bool has_pores = step.material.eos->initial_distension() > 1.0;
  const bool viscous = step.material.strength->viscosity() > 0.0;
  const bool kinematic = step.material.strength->kinematic_modulus() > 0.0;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const bool intact = points.failed[i] == failure::intact;
    const double density = chunk.density[k];
    const double bulk = std::max(chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k],
                                 least_sound_speed * least_sound_speed);
    double squared = bulk;
    double pressure = chunk.acting_pressure[k];
    double carried = 1.0;  // share of the deviator that the point keeps
    if (intact) {
      // What melts or cracks takes its share of the stress with it; what freezes is free of stress.
      const double solid = solid_fraction(step, i, chunk.melted[k]);
      if (!viscous && solid < chunk.solid_fraction[k]) carried = solid / chunk.solid_fraction[k];
      squared += 4.0 / 3.0 * solid * chunk.solid_modulus[k] / density;
      if (step.material.softens && points.damage[i] > 0.0) {
        pressure =
            share_volume(pressure, density * bulk, points.damage[i], points.volume[i], points.void_volume[i]);
      }
    } else {
      pressure = share_volume(pressure, density * bulk, 1.0, points.volume[i], points.void_volume[i]);
      if (pressure <= 0.0) squared = least_sound_speed * least_sound_speed;
      const bool open = points.void_volume[i] > 0.0;
      if (open) points.artificial_viscosity[i] = 0.0;  // opened in this step
      carried = viscous && !open ? 1.0 : 0.0;
    }
    if (carried != 1.0) {
      scale(chunk.motion.deviator, k, carried);
      if (kinematic) scale(chunk.back_stress, k, carried);
    }
    points.pressure[i] = pressure;
    points.deviatoric_stress[i] = tensor(chunk.motion.deviator, k);
    if (kinematic) points.back_stress[i] = tensor(chunk.back_stress, k);
    if (step.material.needs_strain) points.strain[i] = tensor(chunk.strain, k);
    points.plastic_strain[i] = chunk.plastic_strain[k];
    points.temperature[i] = chunk.temperature[k];
    points.melted_fraction[i] = chunk.melted[k];
    points.vaporised_fraction[i] = chunk.vaporised[k];
    if (has_pores) points.distension[i] = chunk.distension[k];
    points.sound_speed[i] = std::sqrt(squared);
    points.maximum_pressure[i] = std::max(points.maximum_pressure[i], pressure);
    points.maximum_temperature[i] = std::max(points.maximum_temperature[i], chunk.temperature[k]);
    if (chunk.melted[k] >= melted_share && points.melting_time[i] == never) {
      points.melting_time[i] = step.settings.time;
    }
  }
}

}  // namespace whipple::material

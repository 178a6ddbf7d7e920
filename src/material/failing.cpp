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
  const double dt = step.settings.time_step;
  Lanes rate, flow, equivalent, before;
  for (std::size_t k = 0; k < chunk.size; ++k) rate[k] = chunk.increment[k] / dt;
  step.material.strength->flow_stress(chunk.strength_state(), chunk.view(rate), chunk.view(flow));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    flow[k] *= 1.0 - chunk.melted[k];
    before[k] = equivalent[k] = std::sqrt(1.5 * tensor(chunk.motion.deviator, k).squared_norm());
  }
  step.material.void_growth->grow_voids(
      {dt, bulk_modulus, chunk.view(chunk.motion.modulus), chunk.view(flow), chunk.view(chunk.motion.trial),
       factor, chunk.view(equivalent), chunk.view(chunk.acting_pressure), chunk.view(chunk.increment),
       chunk.view(chunk.plastic_strain), chunk.view(chunk.volume), chunk.view(chunk.void_volume)},
      damage, failed);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    if (equivalent[k] != before[k] && before[k] > 0.0) {
      scale(chunk.motion.deviator, k, equivalent[k] / before[k]);
    }
  }
  chunk.any_void = true;
}

/// Pressure of a point with cracks or voids and the division of its volume into matter and void: the share
/// `opening` of what exceeds the volume of zero pressure, or of the pressure `least` where it is all of it,
/// is void (eq. 12, 13, 18).
/// @param modulus  rho c^2 (Pa), bounded from below
/// @returns the pressure that acts
double share_volume(double pressure, double modulus, double opening, double least, double& volume,
                    double& void_volume) {
  const double total = volume + void_volume;
  const double relaxed =
      volume + std::clamp((pressure - least) / modulus, -greatest_void_step, greatest_void_step) * volume;
  const double excess = total - relaxed;
  if (excess > 0.0) {  // tension opens the void, pressure lets the matter grow into it
    const double matter = opening == 1.0 ? relaxed : total - opening * excess;
    const double acting = pressure + modulus * (volume - matter) / volume;
    volume = matter;
    void_volume = total - matter;
    return opening == 1.0 ? least : std::min(acting, 0.0);
  }
  const double acting = pressure - modulus * void_volume / volume;
  volume = total;
  void_volume = 0.0;
  return std::max(acting, least);
}

}  // namespace

void apply_failure(Step& step, Chunk& chunk) {
  std::copy_n(chunk.pressure.data(), chunk.size, chunk.acting_pressure.data());
  if (step.material.brittle) relax_brittle(step, chunk);
  if (step.material.failure.empty()) return;
  Lanes factor, volume, bulk_modulus;
  chunk.fetch(step.points.failure_threshold_factor, factor);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    volume[k] = chunk.volume[k] + chunk.void_volume[k];
    bulk_modulus[k] = chunk.density[k] * chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k];
  }
  const std::array<std::uint8_t, chunk_size> failed_before = chunk.failed;
  if (step.material.void_growth != nullptr) {
    grow_voids(step, chunk, chunk.view(bulk_modulus), chunk.view(factor), chunk.view(chunk.damage),
               chunk.view(chunk.failed));
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
    criterion->mark(state, chunk.view(chunk.damage), chunk.view(chunk.failed));
  }
  chunk.deposit(chunk.damage, step.points.damage);
  if (std::equal(chunk.failed.begin(), chunk.failed.begin() + chunk.size, failed_before.begin())) return;
  chunk.any_failed = true;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    if (chunk.failed[k] != failed_before[k]) ++step.report.failed[chunk.failed[k]];
  }
  chunk.deposit(chunk.failed, step.points.failed);
}

namespace {

/// What a point loses that has failed or melts, or cracks or gaps open in (see `finish`).
/// @param squared  of its sound speed
/// @returns the share of the deviator that it keeps
double lose_strength(const Step& step, Chunk& chunk, std::size_t k, double bulk, double least_sound_speed,
                     double& squared) {
  const bool viscous = step.material.strength->viscosity() > 0.0;
  const double modulus = chunk.density[k] * bulk;
  double& pressure = chunk.acting_pressure[k];
  if (chunk.failed[k] == failure::intact) {
    const double solid = solid_fraction(step, chunk, k);
    squared = bulk + 4.0 / 3.0 * solid * chunk.solid_modulus[k] / chunk.density[k];
    if (step.material.softens && chunk.damage[k] > 0.0) {
      pressure = share_volume(pressure, modulus, chunk.damage[k], 0.0, chunk.volume[k], chunk.void_volume[k]);
    }
    if (step.material.brittle) {
      pressure = share_volume(pressure, modulus, 1.0, chunk.least_pressure[k], chunk.volume[k],
                              chunk.void_volume[k]);
      if (chunk.void_volume[k] > 0.0) {
        squared = least_sound_speed * least_sound_speed;
        chunk.artificial_viscosity[k] = 0.0;
      }
    }
    return !viscous && solid < chunk.solid_fraction[k] ? solid / chunk.solid_fraction[k] : 1.0;
  }
  pressure = share_volume(pressure, modulus, 1.0, 0.0, chunk.volume[k], chunk.void_volume[k]);
  squared = pressure <= 0.0 ? least_sound_speed * least_sound_speed : bulk;
  const bool open = chunk.void_volume[k] > 0.0;
  if (open) chunk.artificial_viscosity[k] = 0.0;  // opened in this step
  return viscous && !open ? 1.0 : 0.0;
}

/// What melts gives back as heat what its dislocations held.
void release_cold_work(Step& step, Chunk& chunk) {
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double solid_before = 1.0 - step.points.melted_fraction[chunk.index[k]],
                 solid = 1.0 - chunk.melted[k];
    if (solid < solid_before) chunk.stored_cold_work[k] *= solid / solid_before;
  }
  chunk.deposit(chunk.stored_cold_work, step.points.stored_cold_work);
}

}  // namespace

void finish(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  const double least_sound_speed = least_sound_speed_ratio * step.material.reference.sound_speed;
  const bool has_pores = step.material.porous;
  const bool kinematic = step.material.strength->kinematic_modulus() > 0.0;
  Lanes bulk, squared, maximum_pressure, maximum_temperature;
  double melted = 0.0;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    bulk[k] = std::max(chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k],
                       least_sound_speed * least_sound_speed);
    squared[k] = bulk[k] + 4.0 / 3.0 * chunk.solid_modulus[k] / chunk.density[k];
    melted = std::max(melted, chunk.melted[k]);
  }
  // What melts or cracks takes its share of the stress with it; what freezes is free of stress.
  if (melted > 0.0 || chunk.any_failed || step.material.softens || step.material.brittle) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const double carried = lose_strength(step, chunk, k, bulk[k], least_sound_speed, squared[k]);
      if (carried == 1.0) continue;
      scale(chunk.motion.deviator, k, carried);
      if (kinematic) scale(chunk.back_stress, k, carried);
    }
    chunk.any_void = true;
  }
  if (step.material.stores_cold_work()) release_cold_work(step, chunk);
  for (std::size_t k = 0; k < chunk.size; ++k) chunk.sound_speed[k] = std::sqrt(squared[k]);
  chunk.fetch(points.maximum_pressure, maximum_pressure);
  chunk.fetch(points.maximum_temperature, maximum_temperature);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    maximum_pressure[k] = std::max(maximum_pressure[k], chunk.acting_pressure[k]);
    maximum_temperature[k] = std::max(maximum_temperature[k], chunk.temperature[k]);
  }
  chunk.deposit(chunk.volume, points.volume);
  if (chunk.any_void) chunk.deposit(chunk.void_volume, points.void_volume);
  chunk.deposit(chunk.artificial_viscosity, points.artificial_viscosity);
  chunk.deposit(chunk.acting_pressure, points.pressure);
  chunk.deposit(chunk.motion.deviator, points.deviatoric_stress);
  if (kinematic) chunk.deposit(chunk.back_stress, points.back_stress);
  if (step.material.needs_strain) chunk.deposit(chunk.strain, points.strain);
  chunk.deposit(chunk.plastic_strain, points.plastic_strain);
  chunk.deposit(chunk.temperature, points.temperature);
  chunk.deposit(chunk.melted, points.melted_fraction);
  chunk.deposit(chunk.vaporised, points.vaporised_fraction);
  if (has_pores) chunk.deposit(chunk.distension, points.distension);
  chunk.deposit(chunk.sound_speed, points.sound_speed);
  chunk.deposit(maximum_pressure, points.maximum_pressure);
  chunk.deposit(maximum_temperature, points.maximum_temperature);
  if (melted < melted_share) return;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    double& time = points.melting_time[chunk.index[k]];
    if (chunk.melted[k] >= melted_share && time == never) time = step.settings.time;
  }
}

}  // namespace whipple::material

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>

#include "src/core/base/simd.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/material/chunk.hpp"

namespace whipple::material {
namespace {

constexpr double greatest_void_step = 0.1;  ///< |dV/V| of material beside its void in one step

failure::Components<const double> view(const Chunk& chunk, const SymmetricLanes& lanes) {
  failure::Components<const double> components;
  for (std::size_t j = 0; j < 6; ++j) components.lane[j] = std::span(lanes[j].data(), chunk.size);
  return components;
}

/// Porous material (eq. 20 to 22, 25, 26): the flow stress is that of the end of the step without voids.
void grow_voids(Step& step, Chunk& chunk, std::span<const double> bulk_modulus,
                std::span<const double> factor, std::span<double> damage, std::span<std::uint8_t> failed) {
  const failure::Criterion& criterion = *step.material.void_growth;
  const double dt = step.settings.time_step;
  Lanes rate, flow, equivalent, before;
  if (criterion.returns_deviator()) {
    for (std::size_t k = 0; k < chunk.size; ++k) rate[k] = chunk.increment[k] / dt;
    step.material.strength->flow_stress(chunk.strength_state(), chunk.view(rate), chunk.view(flow));
    for (std::size_t k = 0; k < chunk.size; ++k) {
      flow[k] *= 1.0 - chunk.melted[k];
      before[k] = equivalent[k] = std::sqrt(1.5 * tensor(chunk.motion.deviator, k).squared_norm());
    }
  }
  criterion.grow_voids(
      {dt, bulk_modulus, chunk.view(chunk.motion.modulus), chunk.view(chunk.melted), chunk.view(flow),
       chunk.view(chunk.motion.trial), factor, chunk.view(equivalent), chunk.view(chunk.acting_pressure),
       chunk.view(chunk.increment), chunk.view(chunk.plastic_strain), chunk.view(chunk.volume),
       chunk.view(chunk.void_volume)},
      damage, failed);
  if (criterion.returns_deviator()) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      if (equivalent[k] != before[k] && before[k] > 0.0) {
        scale(chunk.motion.deviator, k, equivalent[k] / before[k]);
      }
    }
  }
  chunk.any_void |= any_positive(chunk.void_volume, chunk.size);
}

/// Makes points whole again whose void pressure has closed, if the criterion that they failed by heals. Their
/// deviator starts from zero.
void heal(const Step& step, Chunk& chunk) {
  for (const auto& criterion : step.material.failure) {
    const failure::Code code = criterion->healing_code();
    if (code == failure::intact) continue;
    for (std::size_t k = 0; k < chunk.size; ++k) {
      if (chunk.failed[k] != code || chunk.void_volume[k] > 0.0 || !(chunk.pressure[k] > 0.0)) continue;
      chunk.failed[k] = failure::intact;
      if (criterion->accumulates()) chunk.damage[k] = 0.0;
    }
  }
}

using Four = whipple::Lanes;  // points at a time

/// Points with cracks or voids.
struct Porous {
  Four pressure;  ///< Pa, that acts
  Four volume;    ///< m^3 of material
  Four void_volume;
};

/// Pressure and division of the volume into material and void: the fraction `opening` of what exceeds the volume
/// of zero pressure, or of the pressure `least` where it is all of it, is void (eq. 12, 13, 18). Tension
/// opens the void, pressure lets the material grow into it.
/// @param modulus  rho c^2 (Pa), bounded from below
/// @param count    of points: fewer than four at the end of a chunk
/// @param limited  grows by the number of points that are kept from changing more in one step
Porous share_volume(const Porous& points, Four modulus, Four opening, Four least, std::size_t count,
                    std::size_t& limited) {
  const Four pressure = points.pressure, volume = points.volume, total = volume + points.void_volume;
  const Four limit = broadcast(greatest_void_step);
  const Four wanted = (pressure - least) / modulus;
  const Four strain = minimum(maximum(wanted, -limit), limit);
  const Four relaxed = volume + strain * volume, excess = total - relaxed;
  const LanesMask whole = opening == 1.0, open = excess > 0.0;
  const LanesMask beyond = (opening > 0.0) & open & (strain != wanted);
  limited += static_cast<std::size_t>(std::popcount(bits(beyond) & ((1U << std::min<std::size_t>(count, 4)) - 1U)));
  const Four matter = select(whole, relaxed, total - opening * excess);
  const Four cracked = minimum(pressure + modulus * (volume - matter) / volume, Four{});
  const Four closed = maximum(pressure - modulus * points.void_volume / volume, least);
  return {select(open, select(whole, least, cracked), closed), select(open, matter, total),
          select(open, total - matter, Four{})};
}

}  // namespace

void apply_failure(Step& step, Chunk& chunk) {
  std::copy_n(chunk.pressure.data(), chunk.size, chunk.acting_pressure.data());
  if (step.material.brittle) relax_brittle(step, chunk);
  if (step.material.failure.empty()) return;
  Lanes factor, volume, bulk_modulus;
  chunk.fetch_threshold_factor(step.points, factor);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    volume[k] = chunk.volume[k] + chunk.void_volume[k];
    bulk_modulus[k] = chunk.density[k] * chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k];
  }
  const std::array<std::uint8_t, chunk_size> failed_before = chunk.failed;
  if (chunk.any_failed && step.material.heals) heal(step, chunk);
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
  if (step.material.keeps_damage) chunk.deposit(chunk.damage, step.points.damage);
  if (std::equal(chunk.failed.begin(), chunk.failed.begin() + chunk.size, failed_before.begin())) return;
  chunk.find_failed();
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const bool fails = chunk.failed[k] != failed_before[k] && chunk.failed[k] != failure::intact;
    step.report.failed[chunk.failed[k]] += fails ? 1 : 0;
  }
  chunk.deposit(chunk.failed, step.points.failed);
}

namespace {

/// Reduces stress and energy of points that have failed, melt, or contain opening cracks or gaps; `kept` is
/// the fraction of the deviator that they keep.
/// @param squared  of the sound speed
void lose_strength(const Step& step, Chunk& chunk, const Lanes& bulk, double least_sound_speed,
                   Lanes& squared, Lanes& kept) {
  const bool viscous = step.material.strength->viscosity() > 0.0, softens = step.material.softens,
             brittle = step.material.brittle;
  const double least_squared = least_sound_speed * least_sound_speed;
  const LanesMask all = Four{} == Four{}, none = ~all;
  for (std::size_t k = 0; k < chunk.size; k += 4) {
    const auto of = [k](const Lanes& lanes) { return load(&lanes[k]); };
    const LanesMask failed = of(chunk.intact) == 0.0, loose = brittle ? all : failed;
    const Four damage = softens ? of(chunk.damage) : Four{};
    const Four melted = of(chunk.melted), density = of(chunk.density), softest = broadcast(least_squared);
    const Four bearing = select(of(chunk.vaporised) > 0.0, Four{}, 1.0 - melted) * (1.0 - damage);
    const Four solid = select(failed, Four{}, bearing), solid_before = of(chunk.solid_fraction);

    const Four opening = select(loose, broadcast(1.0), damage);
    const Four least = brittle ? select(failed, Four{}, of(chunk.least_pressure)) : Four{};
    const Porous before = {of(chunk.acting_pressure), of(chunk.volume), of(chunk.void_volume)};
    const Porous shared = share_volume(before, density * of(bulk), opening, least, chunk.size - k, step.report.limited_void_steps);
    const LanesMask parts = opening > 0.0;
    const Four pressure = select(parts, shared.pressure, before.pressure);
    const Four void_volume = select(parts, shared.void_volume, before.void_volume);
    store(&chunk.acting_pressure[k], pressure);
    store(&chunk.volume[k], select(parts, shared.volume, before.volume));
    store(&chunk.void_volume[k], void_volume);

    const LanesMask gaping = loose & (void_volume > 0.0);  // opened in this step, or before
    store(&chunk.artificial_viscosity[k], select(gaping, Four{}, of(chunk.artificial_viscosity)));
    const Four of_solid = of(bulk) + 4.0 / 3.0 * solid * of(chunk.solid_modulus) / density;
    const LanesMask slack = (failed & (pressure <= 0.0)) | (~failed & gaping);
    store(&squared[k], select(slack, softest, select(failed, of(bulk), of_solid)));
    const LanesMask melts = viscous ? none : solid < solid_before;
    const Four of_intact = select(melts, solid / solid_before, broadcast(1.0));
    const Four of_failed = viscous ? select(gaping, Four{}, broadcast(1.0)) : Four{};
    store(&kept[k], select(failed, of_failed, of_intact));
  }
}

/// Converts the stored cold work of melting points to heat.
void release_cold_work(Step& step, Chunk& chunk) {
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double solid_before = 1.0 - step.points.melted_fraction[chunk.index[k]],
                 solid = 1.0 - chunk.melted[k];
    if (solid < solid_before) chunk.stored_cold_work[k] *= solid / solid_before;
  }
  chunk.deposit(chunk.stored_cold_work, step.points.stored_cold_work);
}

/// maximum = max(maximum, value) of the first `size`. @returns whether any of them rose
bool raise(Lanes& maximum, const Lanes& value, std::size_t size) {
  std::uint64_t rose = 0;
  for (std::size_t k = 0; k < size; ++k) {
    rose |= value[k] > maximum[k] ? 1U : 0U;
    maximum[k] = value[k] > maximum[k] ? value[k] : maximum[k];
  }
  return rose != 0;
}

}  // namespace

WHIPPLE_KERNEL void finish(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  const double least_sound_speed = least_sound_speed_ratio * step.material.reference.sound_speed;
  const bool has_pores = step.material.porous;
  const bool kinematic = step.material.strength->kinematic_modulus() > 0.0;
  Lanes bulk, squared, maximum_pressure, maximum_temperature;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    bulk[k] = std::max(chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k],
                       least_sound_speed * least_sound_speed);
    squared[k] = bulk[k] + 4.0 / 3.0 * chunk.solid_modulus[k] / chunk.density[k];
  }
  // The deviatoric stress is scaled with what melts or cracks; what freezes is free of stress.
  const bool any_melted = any_positive(chunk.melted, chunk.size);
  if (any_melted || chunk.any_failed || step.material.softens || step.material.brittle) {
    Lanes kept;
    lose_strength(step, chunk, bulk, least_sound_speed, squared, kept);
    const auto scale_all = [&](SymmetricLanes& lanes) {
      for (Lanes& lane : lanes) {
        for (std::size_t k = 0; k < chunk.size; ++k) lane[k] *= kept[k];
      }
    };
    scale_all(chunk.motion.deviator);
    if (kinematic) scale_all(chunk.back_stress);
    chunk.any_void = true;
  }
  if (step.material.stores_cold_work()) release_cold_work(step, chunk);
  for (std::size_t k = 0; k < chunk.size; ++k) chunk.sound_speed[k] = std::sqrt(squared[k]);
  chunk.fetch(points.maximum_pressure, maximum_pressure);
  chunk.fetch(points.maximum_temperature, maximum_temperature);
  const bool new_maximum = raise(maximum_pressure, chunk.acting_pressure, chunk.size) |
                           raise(maximum_temperature, chunk.temperature, chunk.size);
  chunk.deposit(chunk.volume, points.volume);
  chunk.deposit(chunk.artificial_viscosity, points.artificial_viscosity);
  if (step.keeps_losses()) chunk.deposit(chunk.heating_viscosity, points.heating_viscosity);
  chunk.deposit(chunk.acting_pressure, points.pressure);
  chunk.deposit(chunk.plastic_strain, points.plastic_strain);
  chunk.deposit(chunk.temperature, points.temperature);
  chunk.deposit(chunk.sound_speed, points.sound_speed);
  if (any_melted || chunk.any_melted) {
    chunk.deposit(chunk.melted, points.melted_fraction);
    chunk.deposit(chunk.vaporised, points.vaporised_fraction);
  }
  if (new_maximum) {
    chunk.deposit(maximum_pressure, points.maximum_pressure);
    chunk.deposit(maximum_temperature, points.maximum_temperature);
  }
  if (chunk.any_void) chunk.deposit(chunk.void_volume, points.void_volume);
  chunk.deposit(chunk.motion.deviator, points.deviatoric_stress);
  if (kinematic) chunk.deposit(chunk.back_stress, points.back_stress);
  if (step.material.needs_strain) chunk.deposit(chunk.strain, points.strain);
  if (has_pores) chunk.deposit(chunk.distension, points.distension);
  if (!any_melted) return;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    double& time = points.melting_time[chunk.index[k]];
    if (chunk.melted[k] >= melted_share && time == never) time = step.settings.time;
  }
}

}  // namespace whipple::material

// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/update.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "src/core/base/simd.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/material/chunk.hpp"

namespace whipple {
namespace {

constexpr double least_volume_ratio = 0.5;  ///< limits of J in one step; named in the report
constexpr double greatest_volume_ratio = 2.0;
/// Least density as a fraction of the reference density. Thinner material does not expand further: long
/// before, it fills more than the nodes on which its pressure acts, and without a bound isolated vapour would
/// grow by the same factor in every step.
constexpr double least_density_ratio = 1e-9;

using material::Chunk;
using material::chunk_size;
using material::components;
using material::Lanes;
using material::Step;

/// L to lanes: as it is, or its columns, one matrix after the other.
void gather_gradient(const Step& step, Chunk& chunk) {
  material::MatrixLanes& gradient = chunk.motion.gradient;
  if (step.gradient.empty()) {
    for (std::size_t e = 0; e < 9; ++e) {
      std::copy_n(step.components[e], chunk.size, gradient[e].begin());
      std::fill_n(gradient[e].data() + chunk.size, material::padded(chunk.size) - chunk.size, 0.0);
    }
    return;
  }
  const auto row_major = [](std::size_t e) { return e % 3 * 3 + e / 3; };
  const double* from = step.gradient[0].data();
  std::size_t k = 0;
  for (; k + 4 <= chunk.size; k += 4) {
    const double* m = from + 9 * k;
    for (std::size_t half = 0; half < 2; ++half) {
      const double* at = m + 4 * half;
      const auto columns = transposed({load(at), load(at + 9), load(at + 18), load(at + 27)});
      for (std::size_t e = 0; e < 4; ++e) store(&gradient[row_major(4 * half + e)][k], columns[e]);
    }
    store(&gradient[8][k], whipple::Lanes{m[8], m[17], m[26], m[35]});
  }
  for (; k < chunk.size; ++k) {
    for (std::size_t e = 0; e < 9; ++e) gradient[row_major(e)][k] = from[9 * k + e];
  }
  for (; k < material::padded(chunk.size); ++k) {
    for (Lanes& lane : gradient) lane[k] = 0.0;
  }
}

enum class Energy { from_grid, integrated };

WHIPPLE_KERNEL void gather(Step& step, Chunk& chunk, Energy energy) {
  const MaterialPoints& points = step.points;
  chunk.fetch(points.mass, chunk.mass);
  chunk.fetch(points.volume, chunk.volume);
  chunk.fetch(points.void_volume, chunk.void_volume);
  chunk.fetch(points.specific_internal_energy, chunk.specific_internal_energy);
  chunk.fetch(points.pressure, chunk.pressure);
  chunk.fetch(points.temperature, chunk.temperature);
  chunk.fetch(points.plastic_strain, chunk.plastic_strain);
  chunk.fetch(points.sound_speed, chunk.sound_speed);
  const auto zero = [&](Lanes& lane) { std::fill_n(lane.data(), chunk.size, 0.0); };
  if (step.material.eos->has_phases()) {
    chunk.fetch(points.melted_fraction, chunk.melted);
    chunk.fetch(points.vaporised_fraction, chunk.vaporised);
  } else {
    zero(chunk.melted);
    zero(chunk.vaporised);
  }
  chunk.fetch(points.failed, chunk.failed);
  if (step.material.stores_cold_work()) chunk.fetch(points.stored_cold_work, chunk.stored_cold_work);
  if (step.material.keeps_damage) {
    chunk.fetch(points.damage, chunk.damage);
  } else {
    zero(chunk.damage);
  }
  chunk.find_failed();
  chunk.any_void = material::any_positive(chunk.void_volume, chunk.size);
  chunk.any_melted = material::any_positive(chunk.melted, chunk.size);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    chunk.old_volume[k] = chunk.volume[k];
    chunk.density[k] = chunk.mass[k] / chunk.volume[k];
    chunk.solid_fraction[k] = shear_bearing_fraction(chunk.melted[k], chunk.vaporised[k]);
  }
  if (chunk.any_failed || step.material.softens) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      chunk.solid_fraction[k] = material::solid_fraction(step, chunk, k);
    }
  }
  gather_gradient(step, chunk);
  if (energy == Energy::integrated) chunk.fetch(points.deviatoric_stress, chunk.old_deviator);
}

/// Volume of material and void after the step (eq. 1, eq. 11): the total follows J; voids take their part of
/// the change until they are closed.
WHIPPLE_KERNEL void advance_volume(Step& step, Chunk& chunk) {
  Lanes limited;
  material::volume_change(material::padded(chunk.size), step.settings.time_step, chunk.motion);
  const double per_least_density = 1.0 / (least_density_ratio * step.material.reference.density);
  std::size_t beyond = 0, undefined = 0, thinnest = 0;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double ratio = chunk.motion.ratio[k];
    const double room = std::max(chunk.density[k] * per_least_density, 1.0);
    limited[k] = std::min(std::clamp(ratio, least_volume_ratio, greatest_volume_ratio), room);
    beyond += ratio < least_volume_ratio || ratio > greatest_volume_ratio ? 1 : 0;
    thinnest += std::min(ratio, greatest_volume_ratio) > room ? 1 : 0;
    chunk.volume_change[k] = chunk.old_volume[k] * (limited[k] - 1.0);
    chunk.volume[k] = chunk.old_volume[k] * limited[k];
  }
  step.report.limited_volume_changes += beyond;
  step.report.limited_densities += thinnest;
  if (chunk.any_void) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const bool open = chunk.void_volume[k] > 0.0;
      const double advanced = chunk.volume[k];
      chunk.volume[k] = chunk.old_volume[k];
      const double before = chunk.volume[k] + chunk.void_volume[k];
      const double total = before * limited[k], share = material::void_share(step, chunk, k);
      const double matter = std::min(chunk.volume[k] + (1.0 - share) * (total - before), total);
      chunk.volume[k] = open ? matter : advanced;
      chunk.void_volume[k] = open ? total - matter : chunk.void_volume[k];
    }
  }
  if (chunk.any_failed) {
    // Stress acts on the material and strains it as the whole; in failed material, on nothing but itself.
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const double own = chunk.volume[k] - chunk.old_volume[k];
      chunk.volume_change[k] = chunk.intact[k] == 0.0 ? own : chunk.volume_change[k];
    }
  }
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double sum = chunk.specific_internal_energy[k] + chunk.volume[k];
    undefined += !(chunk.volume[k] > 0.0) || !std::isfinite(sum) ? 1 : 0;
  }
  if (undefined == 0) return;
  step.report.undefined += undefined;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double sum = chunk.specific_internal_energy[k] + chunk.volume[k];
    if (chunk.volume[k] > 0.0 && std::isfinite(sum)) continue;
    step.report.first_undefined = std::min(step.report.first_undefined, chunk.index[k]);
  }
}

/// Newtonian fluid: s = 2 eta dev D, without elastic energy.
void viscous_deviator(Step& step, Chunk& chunk) {
  const double twice = 2.0 * step.material.strength->viscosity();
  const material::MatrixLanes& l = chunk.motion.gradient;
  material::SymmetricLanes& s = chunk.motion.deviator;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double mean = (l[0][k] + l[4][k] + l[8][k]) / 3.0;
    s[0][k] = twice * (l[0][k] - mean);
    s[1][k] = twice * (l[4][k] - mean);
    s[2][k] = twice * (l[8][k] - mean);
    s[3][k] = 0.5 * twice * (l[1][k] + l[3][k]);
    s[4][k] = 0.5 * twice * (l[5][k] + l[7][k]);
    s[5][k] = 0.5 * twice * (l[6][k] + l[2][k]);
  }
}

/// Material without elastic deviator: fluids, and chunks where everything has failed or melted.
void advance_without_modulus(Step& step, Chunk& chunk) {
  material::Kinematics& motion = chunk.motion;
  for (Lanes* lane : {&chunk.solid_modulus, &motion.modulus, &motion.trial, &chunk.increment}) {
    std::fill_n(lane->data(), chunk.size, 0.0);
  }
  for (Lanes& lane : motion.deviator) std::fill_n(lane.data(), chunk.size, 0.0);
  for (Lanes& lane : chunk.back_stress) std::fill_n(lane.data(), chunk.size, 0.0);
  const bool viscous = step.material.strength->viscosity() > 0.0;
  if (viscous) viscous_deviator(step, chunk);
  if (viscous || step.material.needs_strain) {
    material::strain_increment(material::padded(chunk.size), step.settings.time_step, step.settings.rotation,
                               motion.gradient, motion.strain);
  } else {
    for (Lanes& lane : motion.strain) std::fill_n(lane.data(), chunk.size, 0.0);
  }
}

/// Tensors of points that carry the deviator; zero elsewhere and in the padding.
void mask_to_solids(const Chunk& chunk, material::SymmetricLanes& tensors) {
  for (Lanes& lane : tensors) {
    for (std::size_t k = 0; k < chunk.size; ++k) lane[k] = chunk.solid_fraction[k] > 0.0 ? lane[k] : 0.0;
    for (std::size_t k = chunk.size; k < material::padded(chunk.size); ++k) lane[k] = 0.0;
  }
}

/// Equivalent stress beside the back stress, and what the return sees as modulus (eq. 16).
void shift_by_back_stress(Step& step, Chunk& chunk, Lanes& modulus) {
  const double third = step.material.strength->kinematic_modulus() / 3.0;
  material::Kinematics& motion = chunk.motion;
  chunk.fetch(step.points.back_stress, chunk.back_stress);
  mask_to_solids(chunk, chunk.back_stress);
  material::turn(material::padded(chunk.size), step.settings.time_step, step.settings.rotation,
                 motion.gradient, chunk.back_stress);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    SymmetricTensor shifted = material::tensor(motion.deviator, k);
    for (std::size_t j = 0; j < 6; ++j) shifted.*components[j] -= chunk.back_stress[j][k];
    motion.trial[k] = std::sqrt(1.5 * shifted.squared_norm());
    modulus[k] = motion.modulus[k] + chunk.solid_fraction[k] * third;
  }
}

/// Accumulates the fraction of the plastic work per volume (J/m^3) that does not become heat (eq. 24).
void store_cold_work(const Step& step, Chunk& chunk, std::size_t k, double work) {
  chunk.stored_cold_work[k] += (1.0 - step.material.taylor_quinney) * work * chunk.volume[k] / chunk.mass[k];
}

/// The radial return by the increments of the plastic strain. @returns the plastic work (J)
WHIPPLE_KERNEL double return_radially(Chunk& chunk) {
  material::Kinematics& motion = chunk.motion;
  Lanes kept;
  double work = 0.0;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double increment = chunk.increment[k], trial = motion.trial[k];
    const double after = std::max(0.0, trial - 3.0 * motion.modulus[k] * increment);
    kept[k] = increment > 0.0 ? after / trial : 1.0;
    chunk.plastic_strain[k] += increment;
    work += after * increment * chunk.volume[k];
  }
  for (Lanes& lane : motion.deviator) {
    for (std::size_t k = 0; k < chunk.size; ++k) lane[k] *= kept[k];
  }
  return work;
}

/// Deviatoric stress: rotation, elastic trial, radial return (eq. 3 to 7, 16).
void advance_deviator(Step& step, Chunk& chunk, Energy energy) {
  material::Kinematics& motion = chunk.motion;
  const auto solid = [](double fraction) { return fraction > 0.0; };
  if (!step.material.strength->carries_deviator() ||
      std::none_of(chunk.solid_fraction.begin(), chunk.solid_fraction.begin() + chunk.size, solid)) {
    advance_without_modulus(step, chunk);
    return;
  }
  const double dt = step.settings.time_step;
  const std::size_t padded = material::padded(chunk.size);
  step.material.strength->shear_modulus(chunk.strength_state(), chunk.view(chunk.solid_modulus));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    motion.modulus[k] = chunk.solid_modulus[k] * chunk.solid_fraction[k];
  }
  for (std::size_t k = chunk.size; k < padded; ++k) motion.modulus[k] = 0.0;
  if (energy == Energy::integrated) {
    motion.deviator = chunk.old_deviator;
  } else {
    chunk.fetch(step.points.deviatoric_stress, motion.deviator);
  }
  mask_to_solids(chunk, motion.deviator);
  material::elastic_trial(padded, dt, step.settings.rotation, motion);
  const bool kinematic = step.material.strength->kinematic_modulus() > 0.0,
             stores = step.material.stores_cold_work();
  Lanes shifted_modulus;
  if (kinematic) shift_by_back_stress(step, chunk, shifted_modulus);
  step.material.strength->plastic_increment(chunk.strength_state(), chunk.view(motion.trial),
                                            chunk.view(kinematic ? shifted_modulus : motion.modulus),
                                            chunk.view(chunk.solid_fraction), dt,
                                            chunk.view(chunk.increment));
  if (!kinematic) {
    step.report.plastic_work += return_radially(chunk);
    if (!stores) return;
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const double increment = chunk.increment[k];
      const double after = std::max(0.0, motion.trial[k] - 3.0 * motion.modulus[k] * increment);
      store_cold_work(step, chunk, k, after * increment);
    }
    return;
  }
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double increment = chunk.increment[k];
    if (!(increment > 0.0)) continue;
    chunk.plastic_strain[k] += increment;
    const double stiffness = 3.0 * motion.modulus[k];
    const double per_trial = increment / motion.trial[k];
    const double hardening = step.material.strength->kinematic_modulus() * chunk.solid_fraction[k];
    double work = 0.0;  // stress : plastic strain increment
    for (std::size_t j = 0; j < 6; ++j) {
      const double shifted = motion.deviator[j][k] - chunk.back_stress[j][k];
      motion.deviator[j][k] -= stiffness * per_trial * shifted;
      chunk.back_stress[j][k] += hardening * per_trial * shifted;
      work += (j < 3 ? 1.5 : 3.0) * per_trial * motion.deviator[j][k] * shifted;
    }
    step.report.plastic_work += work * chunk.volume[k];
    if (stores) store_cold_work(step, chunk, k, work);
  }
}

/// Logarithmic strain, rotated with the material (eq. 17).
void advance_strain(Step& step, Chunk& chunk) {
  if (!step.material.needs_strain) return;
  chunk.fetch(step.points.strain, chunk.strain);
  for (Lanes& lane : chunk.strain) {
    std::fill_n(lane.data() + chunk.size, material::padded(chunk.size) - chunk.size, 0.0);
  }
  material::turn(material::padded(chunk.size), step.settings.time_step, step.settings.rotation,
                 chunk.motion.gradient, chunk.strain);
  for (std::size_t j = 0; j < 6; ++j) {
    for (std::size_t k = 0; k < chunk.size; ++k) chunk.strain[j][k] += chunk.motion.strain[j][k];
  }
}

/// The part of the artificial viscosity whose work is heat (docs/theory/dissipation.md, eq. 6): all of it in
/// a shock, whose rate the affine field of the particle follows; where material meets at first, what the affine
/// field has of the jump. Fragmented material collides: all of it heats.
WHIPPLE_KERNEL void find_heating_viscosity(const Step& step, Chunk& chunk) {
  const UpdateSettings& settings = step.settings;
  const double per_initial = 1.0 / settings.initial_density;
  const double per_range = 1.0 / settings.affine_compression;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double of_grid = std::max(-chunk.motion.divergence[k], 0.0) * settings.cell_size;
    const double of_field = std::max(-step.affine_divergence[k], 0.0) * settings.cell_size;
    const double compression = chunk.density[k] * per_initial - 1.0;
    const double share = std::clamp(1.0 - compression * per_range, 0.0, 1.0);
    const double closing = of_grid - share * std::max(of_grid - settings.affine_gain * of_field, 0.0);
    const double viscosity =
        chunk.density[k] * closing *
        (settings.quadratic_viscosity * closing + settings.linear_viscosity * chunk.sound_speed[k]);
    const bool tight = chunk.intact[k] != 0.0 && compression >= 0.0;
    const double whole = chunk.artificial_viscosity[k];
    chunk.heating_viscosity[k] = tight && whole > 0.0 ? std::min(viscosity, whole) : whole;
  }
}

/// Density, and artificial viscosity (eq. 8): none in failed or brittle material beside an open void.
WHIPPLE_KERNEL void advance_viscosity(Step& step, Chunk& chunk) {
  const UpdateSettings& settings = step.settings;
  const auto advance = [&](const auto& length) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const double closing = -chunk.motion.divergence[k] * length(k);  // l |D|, m/s
      chunk.density[k] = chunk.mass[k] / chunk.volume[k];
      const double viscosity =
          chunk.density[k] * closing *
          (settings.quadratic_viscosity * closing + settings.linear_viscosity * chunk.sound_speed[k]);
      chunk.artificial_viscosity[k] = closing > 0.0 ? viscosity : 0.0;
    }
    if (settings.expansion_viscosity == 0.0) return;
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const double opening = std::max(chunk.motion.divergence[k], 0.0) * length(k);
      const double viscosity =
          chunk.density[k] * opening * settings.expansion_viscosity * chunk.sound_speed[k];
      chunk.artificial_viscosity[k] -= std::min(viscosity, std::max(chunk.pressure[k], 0.0));
    }
  };
  if (settings.lengths.empty()) {
    advance([&](std::size_t) { return settings.cell_size; });
  } else {
    advance([&](std::size_t k) { return settings.lengths[chunk.index[k]]; });
  }
  if (step.keeps_losses()) {
    if (step.affine_divergence.empty()) {
      chunk.heating_viscosity = chunk.artificial_viscosity;
    } else {
      find_heating_viscosity(step, chunk);
    }
  }
  const bool brittle = step.material.brittle;
  if (!(chunk.any_failed || brittle) || !chunk.any_void) return;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const bool loose = brittle || chunk.intact[k] == 0.0;
    chunk.artificial_viscosity[k] = loose && chunk.void_volume[k] > 0.0 ? 0.0 : chunk.artificial_viscosity[k];
  }
}

/// The energy that the equation of state of the symplectic scheme takes: half a step ahead of
/// e^n+1 (pressure and stresses then stand at the end of the step), less the elastic energy of the deviator
/// (eq. 9, 10).
WHIPPLE_KERNEL void prepare_energy(const Step& step, Chunk& chunk) {
  const double half_step = 0.5 * step.settings.time_step;
  const material::SymmetricLanes& lanes = chunk.motion.deviator;
  const material::MatrixLanes& l = chunk.motion.gradient;
  const Lanes& viscosity = step.keeps_losses() ? chunk.heating_viscosity : chunk.artificial_viscosity;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const SymmetricTensor s = material::tensor(lanes, k);
    const double deviatoric = s.xx * l[0][k] + s.yy * l[4][k] + s.zz * l[8][k] + s.xy * (l[1][k] + l[3][k]) +
                              s.yz * (l[5][k] + l[7][k]) + s.zx * (l[2][k] + l[6][k]);
    const double power = deviatoric - (chunk.pressure[k] + viscosity[k]) * chunk.motion.divergence[k];
    const double modulus = chunk.motion.modulus[k];
    const double elastic = s.squared_norm() / (4.0 * (modulus > 0.0 ? modulus : 1.0));
    const double specific_volume = chunk.volume[k] / chunk.mass[k];
    chunk.energy[k] = chunk.specific_internal_energy[k] +
                      (half_step * power - (modulus > 0.0 ? elastic : 0.0)) * specific_volume;
  }
  if (!step.material.stores_cold_work()) return;
  for (std::size_t k = 0; k < chunk.size; ++k) chunk.energy[k] -= chunk.stored_cold_work[k];
}

/// Collects the inputs of the equation of state for a chunk; pressure and temperature are overwritten with
/// the new ones.
eos::Batch ask(Step& step, Chunk& chunk) {
  eos::Batch batch{chunk.view(chunk.density),
                   chunk.view(chunk.energy),
                   chunk.view(chunk.pressure),
                   chunk.view(chunk.temperature),
                   chunk.view(chunk.bulk_sound_speed),
                   {},
                   {}};
  if (step.material.eos->has_phases()) {
    batch.melted_fraction = chunk.view(chunk.melted);
    batch.vaporised_fraction = chunk.view(chunk.vaporised);
  }
  if (step.material.porous) {
    chunk.fetch(step.points.distension, chunk.distension);
    batch.distension = chunk.view(chunk.distension);
  }
  return batch;
}

void book(Step& step, const Chunk& chunk, eos::RangeReport range) {
  if (range.first != eos::RangeReport::none) range.first = chunk.index[range.first];
  step.report.equation_of_state.merge(range);
}

/// The trapezoidal energy step of the schemes without a work identity (eq. 14): e = e_0 - h p(e), h = dV /
/// 2m, where e_0 holds all work but that of the new pressure.
WHIPPLE_KERNEL void work_without_new_pressure(const Step& step, Chunk& chunk, Lanes& half_change) {
  for (std::size_t k = 0; k < chunk.size; ++k) {
    double strain_work = 0.0;  // mean stress : strain increment
    for (std::size_t j = 0; j < 6; ++j) {
      const double mean = 0.5 * (chunk.motion.deviator[j][k] + chunk.old_deviator[j][k]);
      strain_work += (j < 3 ? 1.0 : 2.0) * mean * chunk.motion.strain[j][k];
    }
    const double per_mass = 1.0 / chunk.mass[k];
    const double work = strain_work * 0.5 * (chunk.volume[k] + chunk.old_volume[k]) -
                        chunk.volume_change[k] * (0.5 * chunk.pressure[k] + chunk.artificial_viscosity[k]);
    half_change[k] = 0.5 * chunk.volume_change[k] * per_mass;
    chunk.energy[k] = chunk.specific_internal_energy[k] + work * per_mass;
  }
  if (!step.material.stores_cold_work()) return;
  for (std::size_t k = 0; k < chunk.size; ++k) chunk.energy[k] -= chunk.stored_cold_work[k];
}

void integrate_energy(Step& step, Chunk& chunk) {
  Lanes half_change;
  work_without_new_pressure(step, chunk, half_change);
  const eos::Batch batch = ask(step, chunk);
  book(step, chunk, step.material.eos->integrate(batch, chunk.view(chunk.energy), chunk.view(half_change)));
  std::copy_n(chunk.energy.data(), chunk.size, chunk.specific_internal_energy.data());
  if (!step.material.stores_cold_work()) return;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    chunk.specific_internal_energy[k] += chunk.stored_cold_work[k];
  }
}

/// Determines the compression rate, which bounds the next time step, except where only a void closes.
WHIPPLE_KERNEL void find_compression_rate(Step& step, const Chunk& chunk) {
  const Lanes& divergence = chunk.motion.divergence;
  double rate = step.report.compression_rate;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    rate = std::max(rate, chunk.acting_pressure[k] > 0.0 ? -divergence[k] : 0.0);
  }
  step.report.compression_rate = rate;
}

void update_chunk(Step& step, Chunk& chunk, Energy energy) {
  gather(step, chunk, energy);
  advance_volume(step, chunk);
  advance_deviator(step, chunk, energy);
  advance_strain(step, chunk);
  advance_viscosity(step, chunk);
  if (energy == Energy::from_grid) {
    prepare_energy(step, chunk);
    book(step, chunk, step.material.eos->evaluate(ask(step, chunk)));
  } else {
    integrate_energy(step, chunk);
  }
  material::apply_failure(step, chunk);
  material::finish(step, chunk);
  find_compression_rate(step, chunk);
  if (energy == Energy::from_grid) return;
  // The work of the step took the pressure of the equation of state; a failed point, beside a void, acts with
  // less (eq. 15).
  for (std::size_t k = 0; chunk.any_void && k < chunk.size; ++k) {
    const double excess = chunk.pressure[k] - chunk.acting_pressure[k];
    chunk.specific_internal_energy[k] += 0.5 * chunk.volume_change[k] * excess / chunk.mass[k];
  }
  chunk.deposit(chunk.specific_internal_energy, step.points.specific_internal_energy);
}

/// @param gradient_of  gradient_of(first, count): matrices or components of points from there on
template <class IndexOf, class GradientOf>
MaterialReport update_all(const Material& material, MaterialPoints& points, std::size_t count,
                          IndexOf index_of, GradientOf gradient_of, const UpdateSettings& settings,
                          Energy energy) {
  MaterialReport report;
  Chunk chunk;
  for (std::size_t first = 0; first < count; first += chunk_size) {
    chunk.size = std::min(chunk_size, count - first);
    for (std::size_t k = 0; k < chunk.size; ++k) chunk.index[k] = index_of(first + k);
    chunk.find_runs();
    Step step{material, points, {}, {}, {}, settings, report};
    std::tie(step.gradient, step.components) = gradient_of(first, chunk.size);
    if (!settings.affine_divergence.empty() && settings.affine_compression > 0.0) {
      step.affine_divergence = settings.affine_divergence.subspan(first, chunk.size);
    }
    update_chunk(step, chunk, energy);
  }
  return report;
}

auto by_matrices(std::span<const Matrix3> gradient) {
  return [=](std::size_t first, std::size_t count) {
    return std::pair(gradient.subspan(first, count), GradientComponents{});
  };
}

auto by_components(const GradientComponents& gradient) {
  return [=](std::size_t first, std::size_t) {
    GradientComponents from = gradient;
    for (const double*& component : from) component += first;
    return std::pair(std::span<const Matrix3>(), from);
  };
}

}  // namespace

void MaterialReport::merge(const MaterialReport& other) {
  equation_of_state.merge(other.equation_of_state);
  undefined += other.undefined;
  first_undefined = std::min(first_undefined, other.first_undefined);
  limited_volume_changes += other.limited_volume_changes;
  limited_densities += other.limited_densities;
  limited_void_steps += other.limited_void_steps;
  limited_bulking += other.limited_bulking;
  compression_rate = std::max(compression_rate, other.compression_rate);
  plastic_work += other.plastic_work;
  for (std::size_t code = 0; code < failed.size(); ++code) failed[code] += other.failed[code];
}

MaterialReport update_material(const Material& material, MaterialPoints& points, std::size_t begin,
                               std::size_t end, std::span<const Matrix3> velocity_gradient,
                               const UpdateSettings& settings) {
  return update_all(
      material, points, end - begin, [=](std::size_t k) { return begin + k; }, by_matrices(velocity_gradient),
      settings, Energy::from_grid);
}

MaterialReport update_material(const Material& material, MaterialPoints& points, std::size_t begin,
                               std::size_t end, const GradientComponents& velocity_gradient,
                               const UpdateSettings& settings) {
  return update_all(
      material, points, end - begin, [=](std::size_t k) { return begin + k; },
      by_components(velocity_gradient), settings, Energy::from_grid);
}

MaterialReport update_material(const Material& material, MaterialPoints& points,
                               std::span<const std::uint32_t> indices,
                               std::span<const Matrix3> velocity_gradient, const UpdateSettings& settings) {
  return update_all(
      material, points, indices.size(), [=](std::size_t k) { return std::size_t{indices[k]}; },
      by_matrices(velocity_gradient), settings, Energy::from_grid);
}

MaterialReport update_material_and_energy(const Material& material, MaterialPoints& points, std::size_t begin,
                                          std::size_t end, std::span<const Matrix3> velocity_gradient,
                                          const UpdateSettings& settings) {
  return update_all(
      material, points, end - begin, [=](std::size_t k) { return begin + k; }, by_matrices(velocity_gradient),
      settings, Energy::integrated);
}

MaterialReport update_material_and_energy(const Material& material, MaterialPoints& points,
                                          std::span<const std::uint32_t> indices,
                                          std::span<const Matrix3> velocity_gradient,
                                          const UpdateSettings& settings) {
  return update_all(
      material, points, indices.size(), [=](std::size_t k) { return std::size_t{indices[k]}; },
      by_matrices(velocity_gradient), settings, Energy::integrated);
}

}  // namespace whipple

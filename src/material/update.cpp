// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/update.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/material/kinematics.hpp"

namespace whipple {
namespace {

constexpr double least_volume_ratio = 0.5;  ///< limits of J in one step; named in the report
constexpr double greatest_volume_ratio = 2.0;
constexpr double greatest_void_step = 0.1;       ///< |dV/V| of matter beside its void in one step
constexpr double least_sound_speed_ratio = 0.1;  ///< of the bulk sound speed of the reference state

using material::chunk_size;
using material::Lanes;

/// Scratch of one chunk, on the stack; entry k belongs to point `index[k]`.
struct Chunk {
  std::size_t size = 0;
  std::array<std::size_t, chunk_size> index;
  Lanes density, pressure, temperature, plastic_strain, solid_fraction, old_volume;
  material::Kinematics motion;  // its deviator becomes the new one
  Lanes solid_modulus, increment;
  Lanes energy, bulk_sound_speed, melted, vaporised;
  Lanes distension;  // of porous matter only

  template <class Array>
  auto view(Array& array) {
    return std::span(array.data(), size);
  }
  strength::State strength_state() {
    return {view(density), view(pressure), view(temperature), view(plastic_strain)};
  }
};

struct Step {
  const Material& material;
  MaterialPoints& points;
  std::span<const Matrix3> gradient;  // of this chunk
  const UpdateSettings& settings;
  MaterialReport& report;
};

void gather(Step& step, Chunk& chunk) {
  const MaterialPoints& points = step.points;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    chunk.old_volume[k] = points.volume[i];
    chunk.density[k] = points.mass[i] / points.volume[i];
    chunk.pressure[k] = points.pressure[i];
    chunk.temperature[k] = points.temperature[i];
    chunk.plastic_strain[k] = points.plastic_strain[i];
    chunk.solid_fraction[k] = points.failed[i] == failure::intact ? 1.0 - points.melted_fraction[i] : 0.0;
    for (std::size_t j = 0; j < 9; ++j) {
      chunk.motion.gradient[j][k] = step.gradient[k](static_cast<int>(j / 3), static_cast<int>(j % 3));
    }
  }
  for (std::size_t k = chunk.size; k < material::padded(chunk.size); ++k) {
    for (Lanes& lane : chunk.motion.gradient) lane[k] = 0.0;
  }
}

/// Volume of matter and void after the step (eq. 1, eq. 11): the total follows J; an open void takes the
/// change until it is closed.
void advance_volume(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  material::volume_change(material::padded(chunk.size), step.settings.time_step, chunk.motion);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double ratio = chunk.motion.ratio[k];
    const double limited = std::clamp(ratio, least_volume_ratio, greatest_volume_ratio);
    if (ratio < least_volume_ratio || ratio > greatest_volume_ratio) ++step.report.limited_volume_changes;
    if (points.void_volume[i] > 0.0) {
      const double total = (points.volume[i] + points.void_volume[i]) * limited;
      points.volume[i] = std::min(points.volume[i], total);
      points.void_volume[i] = total - points.volume[i];
    } else {
      points.volume[i] *= limited;
    }
    if (!(points.volume[i] > 0.0) || !std::isfinite(points.specific_internal_energy[i] + points.volume[i])) {
      ++step.report.undefined;
      step.report.first_undefined = std::min(step.report.first_undefined, i);
    }
  }
}

constexpr std::array<double SymmetricTensor::*, 6> components = {&SymmetricTensor::xx, &SymmetricTensor::yy,
                                                                 &SymmetricTensor::zz, &SymmetricTensor::xy,
                                                                 &SymmetricTensor::yz, &SymmetricTensor::zx};

SymmetricTensor deviator(const Chunk& chunk, std::size_t k) {
  const material::SymmetricLanes& s = chunk.motion.deviator;
  return {s[0][k], s[1][k], s[2][k], s[3][k], s[4][k], s[5][k]};
}

void scale_deviator(Chunk& chunk, std::size_t k, double factor) {
  for (Lanes& lane : chunk.motion.deviator) lane[k] *= factor;
}

/// Deviatoric stress: rotation, elastic trial, radial return (eq. 3 to 7).
void advance_deviator(Step& step, Chunk& chunk) {
  const MaterialPoints& points = step.points;
  material::Kinematics& motion = chunk.motion;
  const auto solid = [](double fraction) { return fraction > 0.0; };
  const bool carries = step.material.strength->carries_deviator();
  if (!carries ||
      std::none_of(chunk.solid_fraction.begin(), chunk.solid_fraction.begin() + chunk.size, solid)) {
    std::fill_n(chunk.solid_modulus.data(), chunk.size, 0.0);
    std::fill_n(motion.modulus.data(), chunk.size, 0.0);
    for (Lanes& lane : motion.deviator) std::fill_n(lane.data(), chunk.size, 0.0);
    for (Lanes& lane : motion.strain) std::fill_n(lane.data(), chunk.size, 0.0);
    return;
  }
  const double dt = step.settings.time_step;
  const std::size_t padded = material::padded(chunk.size);
  step.material.strength->shear_modulus(chunk.strength_state(), chunk.view(chunk.solid_modulus));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    motion.modulus[k] = chunk.solid_modulus[k] * chunk.solid_fraction[k];
    const SymmetricTensor& s = points.deviatoric_stress[chunk.index[k]];
    const double carried = solid(chunk.solid_fraction[k]) ? 1.0 : 0.0;  // failed or melted: none
    for (std::size_t j = 0; j < 6; ++j) motion.deviator[j][k] = carried * (s.*components[j]);
  }
  for (std::size_t k = chunk.size; k < padded; ++k) {
    motion.modulus[k] = 0.0;
    for (Lanes& lane : motion.deviator) lane[k] = 0.0;
  }
  material::elastic_trial(padded, dt, motion);
  step.material.strength->plastic_increment(chunk.strength_state(), chunk.view(motion.trial),
                                            chunk.view(motion.modulus), chunk.view(chunk.solid_fraction), dt,
                                            chunk.view(chunk.increment));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    if (!(chunk.increment[k] > 0.0)) continue;
    chunk.plastic_strain[k] += chunk.increment[k];
    scale_deviator(chunk, k,
                   std::max(0.0, 1.0 - 3.0 * motion.modulus[k] * chunk.increment[k] / motion.trial[k]));
  }
}

/// Artificial viscosity (eq. 8): in compression only, none while a void is open.
void advance_viscosity(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  const UpdateSettings& settings = step.settings;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double closing = -chunk.motion.divergence[k] * settings.cell_size;  // l |D|, m/s
    const bool active = closing > 0.0 && !(points.void_volume[i] > 0.0);
    points.artificial_viscosity[i] =
        active
            ? points.mass[i] / points.volume[i] * closing *
                  (settings.quadratic_viscosity * closing + settings.linear_viscosity * points.sound_speed[i])
            : 0.0;
  }
}

/// Density and the energy that the equation of state of the symplectic scheme takes: half a step ahead of
/// e^n+1 (pressure and stresses then stand at the end of the step), less the elastic energy of the deviator
/// (eq. 9, 10).
void prepare_energy(Step& step, Chunk& chunk) {
  const MaterialPoints& points = step.points;
  const double half_step = 0.5 * step.settings.time_step;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const SymmetricTensor s = deviator(chunk, k);
    const material::MatrixLanes& l = chunk.motion.gradient;
    const double deviatoric = s.xx * l[0][k] + s.yy * l[4][k] + s.zz * l[8][k] + s.xy * (l[1][k] + l[3][k]) +
                              s.yz * (l[5][k] + l[7][k]) + s.zx * (l[2][k] + l[6][k]);
    const double power =
        deviatoric - (points.pressure[i] + points.artificial_viscosity[i]) * chunk.motion.divergence[k];
    const double modulus = chunk.motion.modulus[k];
    const double elastic = modulus > 0.0 ? s.squared_norm() / (4.0 * modulus) : 0.0;
    const double specific_volume = points.volume[i] / points.mass[i];
    chunk.energy[k] = points.specific_internal_energy[i] + (half_step * power - elastic) * specific_volume;
  }
}

bool porous(const Step& step) { return step.material.eos->initial_distension() > 1.0; }

/// One call for the chunk; density, pressure and temperature become the new ones.
eos::RangeReport evaluate(Step& step, Chunk& chunk) {
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    chunk.density[k] = step.points.mass[i] / step.points.volume[i];
  }
  eos::Batch batch{chunk.view(chunk.density),          chunk.view(chunk.energy),
                   chunk.view(chunk.pressure),         chunk.view(chunk.temperature),
                   chunk.view(chunk.bulk_sound_speed), chunk.view(chunk.melted),
                   chunk.view(chunk.vaporised)};
  if (porous(step)) {  // always from the distension before the step, which `finish` replaces
    for (std::size_t k = 0; k < chunk.size; ++k) {
      chunk.distension[k] = step.points.distension[chunk.index[k]];
    }
    batch.distension = chunk.view(chunk.distension);
  }
  eos::RangeReport range = step.material.eos->evaluate(batch);
  if (range.first != eos::RangeReport::none) range.first = chunk.index[range.first];
  return range;
}

/// The trapezoidal energy step of the schemes without a work identity (eq. 14): e = e_0 - h p(e), h = dV /
/// 2m, where e_0 holds all work but that of the new pressure. Two evaluations and the secant through them:
/// exact for an equation of state that is linear in e at constant density.
eos::RangeReport integrate_energy(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  Lanes without_new_pressure, first_energy, first_pressure;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double change = points.volume[i] - chunk.old_volume[k];
    double strain_work = 0.0;  // mean stress : strain increment
    for (std::size_t j = 0; j < 6; ++j) {
      const double mean = 0.5 * (chunk.motion.deviator[j][k] + points.deviatoric_stress[i].*components[j]);
      strain_work += (j < 3 ? 1.0 : 2.0) * mean * chunk.motion.strain[j][k];
    }
    const double work = strain_work * 0.5 * (points.volume[i] + chunk.old_volume[k]) -
                        change * (0.5 * points.pressure[i] + points.artificial_viscosity[i]);
    without_new_pressure[k] = points.specific_internal_energy[i] + work / points.mass[i];
    chunk.energy[k] = without_new_pressure[k] - 0.5 * change * points.pressure[i] / points.mass[i];
    first_energy[k] = chunk.energy[k];
  }
  eos::RangeReport range = evaluate(step, chunk);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double h = 0.5 * (points.volume[i] - chunk.old_volume[k]) / points.mass[i];
    first_pressure[k] = chunk.pressure[k];
    chunk.energy[k] = without_new_pressure[k] - h * first_pressure[k];
  }
  range.merge(evaluate(step, chunk));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double h = 0.5 * (points.volume[i] - chunk.old_volume[k]) / points.mass[i];
    const double span = chunk.energy[k] - first_energy[k];
    const double slope = (chunk.pressure[k] - first_pressure[k]) / span;
    const bool resolved = std::abs(span) > 1e-9 * std::abs(chunk.energy[k]) && h * slope > -0.5;
    const double gain = h * (first_pressure[k] - chunk.pressure[k]) / (resolved ? 1.0 + h * slope : 1.0);
    chunk.energy[k] += gain;
    if (resolved) chunk.pressure[k] += slope * gain;
    points.specific_internal_energy[i] = chunk.energy[k];
  }
  return range;
}

void apply_failure(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  if (step.material.failure.empty()) return;
  Lanes factor;
  std::array<std::uint8_t, chunk_size> failed;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    factor[k] = points.failure_threshold_factor[chunk.index[k]];
    failed[k] = points.failed[chunk.index[k]];
  }
  for (const auto& criterion : step.material.failure) {
    criterion->mark({chunk.view(chunk.pressure), chunk.view(chunk.plastic_strain), chunk.view(chunk.melted),
                     chunk.view(factor)},
                    chunk.view(failed));
  }
  for (std::size_t k = 0; k < chunk.size; ++k) {
    std::uint8_t& code = points.failed[chunk.index[k]];
    if (failed[k] == code) continue;
    code = failed[k];
    ++(code == failure::tensile ? step.report.failed_tensile : step.report.failed_plastic);
  }
}

/// Pressure of a failed point and the division of its volume into matter and void (eq. 11 to 13).
/// @param modulus  rho c^2 (Pa), bounded from below
/// @returns the pressure that acts (>= 0)
double share_volume(double pressure, double modulus, double& volume, double& void_volume) {
  const double total = volume + void_volume;
  const double relaxation = std::clamp(pressure / modulus, -greatest_void_step, greatest_void_step) * volume;
  if (relaxation < void_volume) {  // tension opens the void, pressure lets the matter grow into it
    volume += relaxation;
    void_volume = total - volume;
    return 0.0;
  }
  const double acting = pressure - modulus * void_volume / volume;
  volume = total;
  void_volume = 0.0;
  return std::max(acting, 0.0);
}

/// Failed points, loss of the deviator by melting, sound speed; writes the new state.
void finish(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  const double least_sound_speed = least_sound_speed_ratio * step.material.reference.sound_speed;
  const bool has_pores = porous(step);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const bool intact = points.failed[i] == failure::intact;
    const double density = chunk.density[k];
    const double bulk = std::max(chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k],
                                 least_sound_speed * least_sound_speed);
    double squared = bulk;
    double pressure = chunk.pressure[k];
    if (intact) {
      const double solid = 1.0 - chunk.melted[k];
      // What melts takes its share of the stress with it; what freezes is free of stress.
      if (solid < chunk.solid_fraction[k]) scale_deviator(chunk, k, solid / chunk.solid_fraction[k]);
      squared += 4.0 / 3.0 * solid * chunk.solid_modulus[k] / density;
    } else {
      scale_deviator(chunk, k, 0.0);
      pressure = share_volume(pressure, density * bulk, points.volume[i], points.void_volume[i]);
      if (pressure <= 0.0) squared = least_sound_speed * least_sound_speed;
      if (points.void_volume[i] > 0.0) points.artificial_viscosity[i] = 0.0;  // opened in this step
    }
    points.pressure[i] = pressure;
    points.deviatoric_stress[i] = deviator(chunk, k);
    points.plastic_strain[i] = chunk.plastic_strain[k];
    points.temperature[i] = chunk.temperature[k];
    points.melted_fraction[i] = chunk.melted[k];
    points.vaporised_fraction[i] = chunk.vaporised[k];
    if (has_pores) points.distension[i] = chunk.distension[k];
    points.sound_speed[i] = std::sqrt(squared);
  }
}

enum class Energy { from_grid, integrated };

void update_chunk(Step& step, Chunk& chunk, Energy energy) {
  gather(step, chunk);
  advance_volume(step, chunk);
  advance_deviator(step, chunk);
  advance_viscosity(step, chunk);
  if (energy == Energy::from_grid) {
    prepare_energy(step, chunk);
    step.report.equation_of_state.merge(evaluate(step, chunk));
    apply_failure(step, chunk);
    finish(step, chunk);
    return;
  }
  step.report.equation_of_state.merge(integrate_energy(step, chunk));
  apply_failure(step, chunk);
  Lanes change;
  for (std::size_t k = 0; k < chunk.size; ++k)
    change[k] = step.points.volume[chunk.index[k]] - chunk.old_volume[k];
  finish(step, chunk);
  // The work of the step took the pressure of the equation of state; a failed point acts with less (eq. 15).
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double excess = chunk.pressure[k] - step.points.pressure[i];
    step.points.specific_internal_energy[i] += 0.5 * change[k] * excess / step.points.mass[i];
  }
}

template <class IndexOf>
MaterialReport update_all(const Material& material, MaterialPoints& points, std::size_t count,
                          IndexOf index_of, std::span<const Matrix3> velocity_gradient,
                          const UpdateSettings& settings, Energy energy) {
  MaterialReport report;
  Chunk chunk;
  for (std::size_t first = 0; first < count; first += chunk_size) {
    chunk.size = std::min(chunk_size, count - first);
    for (std::size_t k = 0; k < chunk.size; ++k) chunk.index[k] = index_of(first + k);
    Step step{material, points, velocity_gradient.subspan(first, chunk.size), settings, report};
    update_chunk(step, chunk, energy);
  }
  return report;
}

}  // namespace

void MaterialReport::merge(const MaterialReport& other) {
  equation_of_state.merge(other.equation_of_state);
  undefined += other.undefined;
  first_undefined = std::min(first_undefined, other.first_undefined);
  limited_volume_changes += other.limited_volume_changes;
  failed_tensile += other.failed_tensile;
  failed_plastic += other.failed_plastic;
}

MaterialReport update_material(const Material& material, MaterialPoints& points, std::size_t begin,
                               std::size_t end, std::span<const Matrix3> velocity_gradient,
                               const UpdateSettings& settings) {
  return update_all(
      material, points, end - begin, [=](std::size_t k) { return begin + k; }, velocity_gradient, settings,
      Energy::from_grid);
}

MaterialReport update_material(const Material& material, MaterialPoints& points,
                               std::span<const std::uint32_t> indices,
                               std::span<const Matrix3> velocity_gradient, const UpdateSettings& settings) {
  return update_all(
      material, points, indices.size(), [=](std::size_t k) { return std::size_t{indices[k]}; },
      velocity_gradient, settings, Energy::from_grid);
}

MaterialReport update_material_and_energy(const Material& material, MaterialPoints& points, std::size_t begin,
                                          std::size_t end, std::span<const Matrix3> velocity_gradient,
                                          const UpdateSettings& settings) {
  return update_all(
      material, points, end - begin, [=](std::size_t k) { return begin + k; }, velocity_gradient, settings,
      Energy::integrated);
}

MaterialReport update_material_and_energy(const Material& material, MaterialPoints& points,
                                          std::span<const std::uint32_t> indices,
                                          std::span<const Matrix3> velocity_gradient,
                                          const UpdateSettings& settings) {
  return update_all(
      material, points, indices.size(), [=](std::size_t k) { return std::size_t{indices[k]}; },
      velocity_gradient, settings, Energy::integrated);
}

}  // namespace whipple

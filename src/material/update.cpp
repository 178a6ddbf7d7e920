// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/update.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/material/kinematics.hpp"

namespace whipple {
namespace {

constexpr std::size_t chunk_size = 256;     ///< the scratch of a chunk stays in the second-level cache
constexpr double least_volume_ratio = 0.5;  ///< limits of J in one step; named in the report
constexpr double greatest_volume_ratio = 2.0;
constexpr double greatest_void_step = 0.1;       ///< |dV/V| of matter beside its void in one step
constexpr double least_sound_speed_ratio = 0.1;  ///< of the bulk sound speed of the reference state

using Doubles = std::array<double, chunk_size>;
using Tensors = std::array<SymmetricTensor, chunk_size>;

/// Scratch of one chunk, on the stack; entry k belongs to point `index[k]`.
struct Chunk {
  std::size_t size = 0;
  std::array<std::size_t, chunk_size> index;
  // old state
  Doubles density, pressure, temperature, plastic_strain, solid_fraction, old_volume;
  // kinematics and strength
  Doubles divergence, solid_modulus, modulus, trial, increment;
  Tensors deviator, strain;  // new deviatoric stress; strain increment of the step
  // equation of state
  Doubles energy, bulk_sound_speed, melted, vaporised;

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
  }
}

/// Volume of matter and void after the step (eq. 1, eq. 11): the total follows J; an open void takes the
/// change until it is closed.
void advance_volume(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  const double dt = step.settings.time_step;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const Matrix3& gradient = step.gradient[k];
    chunk.divergence[k] = gradient.trace();
    const double ratio = volume_ratio(gradient, dt);
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

/// Deviatoric stress: rotation, elastic trial, radial return (eq. 3 to 7).
void advance_deviator(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  if (!step.material.strength->carries_deviator()) {
    std::fill_n(chunk.solid_modulus.data(), chunk.size, 0.0);
    std::fill_n(chunk.modulus.data(), chunk.size, 0.0);
    std::fill_n(chunk.deviator.data(), chunk.size, SymmetricTensor{});
    std::fill_n(chunk.strain.data(), chunk.size, SymmetricTensor{});
    return;
  }
  const double dt = step.settings.time_step;
  step.material.strength->shear_modulus(chunk.strength_state(), chunk.view(chunk.solid_modulus));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    chunk.modulus[k] = chunk.solid_modulus[k] * chunk.solid_fraction[k];
    if (!(chunk.modulus[k] > 0.0)) {  // failed or melted
      chunk.deviator[k] = {};
      chunk.strain[k] = {};
      chunk.trial[k] = 0.0;
      chunk.modulus[k] = 0.0;
      continue;
    }
    const Matrix3 midpoint = midpoint_gradient(step.gradient[k], dt);
    SymmetricTensor strain = symmetric_part(midpoint);
    scale(strain, dt);
    SymmetricTensor s = rotated(points.deviatoric_stress[i], step_rotation(midpoint, dt));
    const double twice = 2.0 * chunk.modulus[k];
    const double mean = trace(strain) / 3.0;
    s.xx += twice * (strain.xx - mean);
    s.yy += twice * (strain.yy - mean);
    s.zz += twice * (strain.zz - mean);
    s.xy += twice * strain.xy;
    s.yz += twice * strain.yz;
    s.zx += twice * strain.zx;
    chunk.strain[k] = strain;
    chunk.deviator[k] = s;
    chunk.trial[k] = equivalent_stress(s);
  }
  step.material.strength->plastic_increment(chunk.strength_state(), chunk.view(chunk.trial),
                                            chunk.view(chunk.modulus), chunk.view(chunk.solid_fraction), dt,
                                            chunk.view(chunk.increment));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    if (!(chunk.modulus[k] > 0.0 && chunk.increment[k] > 0.0)) continue;
    chunk.plastic_strain[k] += chunk.increment[k];
    scale(chunk.deviator[k],
          std::max(0.0, 1.0 - 3.0 * chunk.modulus[k] * chunk.increment[k] / chunk.trial[k]));
  }
}

/// Artificial viscosity (eq. 8): in compression only, none while a void is open.
void advance_viscosity(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  const UpdateSettings& settings = step.settings;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double closing = -chunk.divergence[k] * settings.cell_size;  // l |D|, m/s
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
    const SymmetricTensor& s = chunk.deviator[k];
    const double power = contract(s, symmetric_part(step.gradient[k])) -
                         (points.pressure[i] + points.artificial_viscosity[i]) * chunk.divergence[k];
    const double elastic = chunk.modulus[k] > 0.0 ? s.squared_norm() / (4.0 * chunk.modulus[k]) : 0.0;
    const double specific_volume = points.volume[i] / points.mass[i];
    chunk.energy[k] = points.specific_internal_energy[i] + (half_step * power - elastic) * specific_volume;
  }
}

/// One call for the chunk; density, pressure and temperature become the new ones.
eos::RangeReport evaluate(Step& step, Chunk& chunk) {
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    chunk.density[k] = step.points.mass[i] / step.points.volume[i];
  }
  eos::RangeReport range = step.material.eos->evaluate(
      {chunk.view(chunk.density), chunk.view(chunk.energy), chunk.view(chunk.pressure),
       chunk.view(chunk.temperature), chunk.view(chunk.bulk_sound_speed), chunk.view(chunk.melted),
       chunk.view(chunk.vaporised)});
  if (range.first != eos::RangeReport::none) range.first = chunk.index[range.first];
  return range;
}

/// The trapezoidal energy step of the schemes without a work identity (eq. 14): e = e_0 - h p(e), h = dV /
/// 2m, where e_0 holds all work but that of the new pressure. Two evaluations and the secant through them:
/// exact for an equation of state that is linear in e at constant density.
eos::RangeReport integrate_energy(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  Doubles without_new_pressure, first_energy, first_pressure;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double change = points.volume[i] - chunk.old_volume[k];
    SymmetricTensor mean = chunk.deviator[k];
    const SymmetricTensor& old = points.deviatoric_stress[i];
    mean = {0.5 * (mean.xx + old.xx), 0.5 * (mean.yy + old.yy), 0.5 * (mean.zz + old.zz),
            0.5 * (mean.xy + old.xy), 0.5 * (mean.yz + old.yz), 0.5 * (mean.zx + old.zx)};
    const double work = contract(mean, chunk.strain[k]) * 0.5 * (points.volume[i] + chunk.old_volume[k]) -
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
  Doubles factor;
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
    if (pressure >= 0.0 && void_volume == 0.0) return pressure;
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
      if (solid < chunk.solid_fraction[k]) scale(chunk.deviator[k], solid / chunk.solid_fraction[k]);
      squared += 4.0 / 3.0 * solid * chunk.solid_modulus[k] / density;
    } else {
      chunk.deviator[k] = {};
      pressure = share_volume(pressure, density * bulk, points.volume[i], points.void_volume[i]);
      if (pressure <= 0.0) squared = least_sound_speed * least_sound_speed;
    }
    points.pressure[i] = pressure;
    points.deviatoric_stress[i] = chunk.deviator[k];
    points.plastic_strain[i] = chunk.plastic_strain[k];
    points.temperature[i] = chunk.temperature[k];
    points.melted_fraction[i] = chunk.melted[k];
    points.vaporised_fraction[i] = chunk.vaporised[k];
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
  Doubles change;
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

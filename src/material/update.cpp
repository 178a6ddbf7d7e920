// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/update.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/material/chunk.hpp"

namespace whipple {
namespace {

constexpr double least_volume_ratio = 0.5;  ///< limits of J in one step; named in the report
constexpr double greatest_volume_ratio = 2.0;

using material::Chunk;
using material::chunk_size;
using material::components;
using material::Lanes;
using material::Step;

void gather(Step& step, Chunk& chunk) {
  const MaterialPoints& points = step.points;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    chunk.old_volume[k] = points.volume[i];
    chunk.density[k] = points.mass[i] / points.volume[i];
    chunk.pressure[k] = points.pressure[i];
    chunk.temperature[k] = points.temperature[i];
    chunk.plastic_strain[k] = points.plastic_strain[i];
    chunk.solid_fraction[k] = material::solid_fraction(step, i, points.melted_fraction[i]);
    for (std::size_t j = 0; j < 9; ++j) {
      chunk.motion.gradient[j][k] = step.gradient[k](static_cast<int>(j / 3), static_cast<int>(j % 3));
    }
  }
  for (std::size_t k = chunk.size; k < material::padded(chunk.size); ++k) {
    for (Lanes& lane : chunk.motion.gradient) lane[k] = 0.0;
  }
}

/// Volume of matter and void after the step (eq. 1, eq. 11): the total follows J; voids take their share of
/// the change until they are closed.
void advance_volume(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  material::volume_change(material::padded(chunk.size), step.settings.time_step, chunk.motion);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double ratio = chunk.motion.ratio[k];
    const double limited = std::clamp(ratio, least_volume_ratio, greatest_volume_ratio);
    if (ratio < least_volume_ratio || ratio > greatest_volume_ratio) ++step.report.limited_volume_changes;
    const double before = points.volume[i] + points.void_volume[i];
    if (points.void_volume[i] > 0.0) {
      const double total = before * limited, share = material::void_share(step, i);
      points.volume[i] = std::min(points.volume[i] + (1.0 - share) * (total - before), total);
      points.void_volume[i] = total - points.volume[i];
    } else {
      points.volume[i] *= limited;
    }
    // Stress acts on the matter and strains it as the whole; in failed matter, on nothing but itself.
    chunk.volume_change[k] = points.failed[i] == failure::intact ? chunk.old_volume[k] * (limited - 1.0)
                                                                 : points.volume[i] - chunk.old_volume[k];
    if (!(points.volume[i] > 0.0) || !std::isfinite(points.specific_internal_energy[i] + points.volume[i])) {
      ++step.report.undefined;
      step.report.first_undefined = std::min(step.report.first_undefined, i);
    }
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

/// Matter without elastic deviator: fluids, and chunks where everything has failed or melted.
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
void gather(const Chunk& chunk, const std::vector<SymmetricTensor>& from, bool solids_only,
            material::SymmetricLanes& to) {
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double carried = solids_only && !(chunk.solid_fraction[k] > 0.0) ? 0.0 : 1.0;
    for (std::size_t j = 0; j < 6; ++j) to[j][k] = carried * (from[chunk.index[k]].*components[j]);
  }
  for (std::size_t k = chunk.size; k < material::padded(chunk.size); ++k) {
    for (Lanes& lane : to) lane[k] = 0.0;
  }
}

/// Equivalent stress beside the back stress, and what the return sees as modulus (eq. 16).
void shift_by_back_stress(Step& step, Chunk& chunk, Lanes& modulus) {
  const double third = step.material.strength->kinematic_modulus() / 3.0;
  material::Kinematics& motion = chunk.motion;
  gather(chunk, step.points.back_stress, true, chunk.back_stress);
  material::turn(material::padded(chunk.size), step.settings.time_step, step.settings.rotation,
                 motion.gradient, chunk.back_stress);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    SymmetricTensor shifted = material::tensor(motion.deviator, k);
    for (std::size_t j = 0; j < 6; ++j) shifted.*components[j] -= chunk.back_stress[j][k];
    motion.trial[k] = std::sqrt(1.5 * shifted.squared_norm());
    modulus[k] = motion.modulus[k] + chunk.solid_fraction[k] * third;
  }
}

/// Deviatoric stress: rotation, elastic trial, radial return (eq. 3 to 7, 16).
void advance_deviator(Step& step, Chunk& chunk) {
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
  gather(chunk, step.points.deviatoric_stress, true, motion.deviator);
  material::elastic_trial(padded, dt, step.settings.rotation, motion);
  const bool kinematic = step.material.strength->kinematic_modulus() > 0.0;
  Lanes shifted_modulus;
  if (kinematic) shift_by_back_stress(step, chunk, shifted_modulus);
  step.material.strength->plastic_increment(chunk.strength_state(), chunk.view(motion.trial),
                                            chunk.view(kinematic ? shifted_modulus : motion.modulus),
                                            chunk.view(chunk.solid_fraction), dt,
                                            chunk.view(chunk.increment));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double increment = chunk.increment[k];
    if (!(increment > 0.0)) continue;
    chunk.plastic_strain[k] += increment;
    const double stiffness = 3.0 * motion.modulus[k];
    if (!kinematic) {
      material::scale(motion.deviator, k, std::max(0.0, 1.0 - stiffness * increment / motion.trial[k]));
      continue;
    }
    const double per_trial = increment / motion.trial[k];
    const double hardening = step.material.strength->kinematic_modulus() * chunk.solid_fraction[k];
    for (std::size_t j = 0; j < 6; ++j) {
      const double shifted = motion.deviator[j][k] - chunk.back_stress[j][k];
      motion.deviator[j][k] -= stiffness * per_trial * shifted;
      chunk.back_stress[j][k] += hardening * per_trial * shifted;
    }
  }
}

/// Logarithmic strain, turned with the matter (eq. 17).
void advance_strain(Step& step, Chunk& chunk) {
  if (!step.material.needs_strain) return;
  gather(chunk, step.points.strain, false, chunk.strain);
  material::turn(material::padded(chunk.size), step.settings.time_step, step.settings.rotation,
                 chunk.motion.gradient, chunk.strain);
  for (std::size_t j = 0; j < 6; ++j) {
    for (std::size_t k = 0; k < chunk.size; ++k) chunk.strain[j][k] += chunk.motion.strain[j][k];
  }
}

/// Artificial viscosity (eq. 8): in compression only, none in failed matter beside an open void.
void advance_viscosity(Step& step, Chunk& chunk) {
  MaterialPoints& points = step.points;
  const UpdateSettings& settings = step.settings;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double length = settings.lengths.empty() ? settings.cell_size : settings.lengths[i];
    const double closing = -chunk.motion.divergence[k] * length;  // l |D|, m/s
    const bool open = points.failed[i] != failure::intact && points.void_volume[i] > 0.0;
    const bool active = closing > 0.0 && !open;
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
    const SymmetricTensor s = material::tensor(chunk.motion.deviator, k);
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
    const double change = chunk.volume_change[k];
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
    const double h = 0.5 * chunk.volume_change[k] / points.mass[i];
    first_pressure[k] = chunk.pressure[k];
    chunk.energy[k] = without_new_pressure[k] - h * first_pressure[k];
  }
  range.merge(evaluate(step, chunk));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double h = 0.5 * chunk.volume_change[k] / points.mass[i];
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

enum class Energy { from_grid, integrated };

void update_chunk(Step& step, Chunk& chunk, Energy energy) {
  gather(step, chunk);
  advance_volume(step, chunk);
  advance_deviator(step, chunk);
  advance_strain(step, chunk);
  advance_viscosity(step, chunk);
  if (energy == Energy::from_grid) {
    prepare_energy(step, chunk);
    step.report.equation_of_state.merge(evaluate(step, chunk));
    material::apply_failure(step, chunk);
    material::finish(step, chunk);
    return;
  }
  step.report.equation_of_state.merge(integrate_energy(step, chunk));
  material::apply_failure(step, chunk);
  material::finish(step, chunk);
  // The work of the step took the pressure of the equation of state; a failed point acts with less (eq. 15).
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const std::size_t i = chunk.index[k];
    const double excess = chunk.pressure[k] - step.points.pressure[i];
    step.points.specific_internal_energy[i] += 0.5 * chunk.volume_change[k] * excess / step.points.mass[i];
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
  for (std::size_t code = 0; code < failed.size(); ++code) failed[code] += other.failed[code];
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

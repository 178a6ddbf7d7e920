// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "src/core/base/vector_math.hpp"
#include "src/material/eos_strength/parts.hpp"

namespace whipple::material::parts {
namespace {

void viscous_stress(const Step& step, Chunk& chunk) {
  const double twice = 2.0 * step.material.strength->viscosity();
  const MatrixLanes& l = chunk.motion.gradient;
  SymmetricLanes& s = chunk.motion.deviator;
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

/// Clears the elastic deviator of fluids, and of chunks in which everything has failed or melted.
void clear_deviator(Chunk& chunk) {
  Kinematics& motion = chunk.motion;
  for (Lanes* lane : {&chunk.solid_modulus, &motion.modulus, &motion.trial, &chunk.increment}) {
    std::fill_n(lane->data(), chunk.size, 0.0);
  }
  for (Lanes& lane : motion.deviator) std::fill_n(lane.data(), chunk.size, 0.0);
}

void find_strain(const Step& step, Chunk& chunk) {
  strain_increment(padded(chunk.size), step.settings.time_step, step.settings.rotation, chunk.motion.gradient,
                   chunk.motion.strain);
}

bool any_solid(const Chunk& chunk) { return any_positive(chunk.solid_fraction, chunk.size); }

/// Sets tensors to zero except for points that carry the deviator; also clears the padding.
void mask_to_solids(const Chunk& chunk, std::span<Lanes, 6> tensors) {
  for (Lanes& lane : tensors) {
    for (std::size_t k = 0; k < chunk.size; ++k) lane[k] = chunk.solid_fraction[k] > 0.0 ? lane[k] : 0.0;
    for (std::size_t k = chunk.size; k < padded(chunk.size); ++k) lane[k] = 0.0;
  }
}

/// Computes modulus and elastic trial of a chunk with solids.
void find_trial(const EosStrength& model, const Step& step, Chunk& chunk) {
  Kinematics& motion = chunk.motion;
  step.material.strength->shear_modulus(chunk.strength_state(chunk.old_density, model.threshold_stress),
                                        chunk.view(chunk.solid_modulus));
  for (std::size_t k = 0; k < chunk.size; ++k) {
    motion.modulus[k] = chunk.solid_modulus[k] * chunk.solid_fraction[k];
  }
  for (std::size_t k = chunk.size; k < padded(chunk.size); ++k) motion.modulus[k] = 0.0;
  chunk.fetch(step.points.deviatoric_stress, motion.deviator);
  mask_to_solids(chunk, motion.deviator);
  material::elastic_trial(padded(chunk.size), step.settings.time_step, step.settings.rotation, motion);
}

/// Computes the increments of the plastic strain.
/// @param modulus  effective shear modulus of the return
void find_increment(const EosStrength& model, const Step& step, Chunk& chunk, Lanes& modulus) {
  Lanes* bearing = &chunk.solid_fraction;
  Lanes weakened;
  if (!step.points.strength_factor
           .empty()) {  // a return sees this fraction in the flow stress and its slope alone
    chunk.fetch(step.points.strength_factor, weakened);
    for (std::size_t k = 0; k < chunk.size; ++k) weakened[k] *= chunk.solid_fraction[k];
    bearing = &weakened;
  }
  step.material.strength->plastic_increment(
      chunk.strength_state(chunk.old_density, model.threshold_stress), chunk.view(chunk.motion.trial),
      chunk.view(modulus), chunk.view(*bearing), step.settings.time_step, chunk.view(chunk.increment));
}

/// Adds the fraction of the plastic work per volume (J/m^3) that does not become heat to the stored energy (eq. 24).
void add_cold_work(const Step& step, Chunk& chunk, Lanes& stored, std::size_t k, double work) {
  const double kept = (1.0 - step.material.taylor_quinney) * work * chunk.volume[k];
  stored[k] += kept / chunk.mass[k];
  chunk.report.plastic_heat -= kept;
}

/// Performs the radial return for the given increments of the plastic strain.
/// @returns the plastic work, J
WHIPPLE_KERNEL double return_to_surface(Chunk& chunk) {
  Kinematics& motion = chunk.motion;
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

/// Computes the equivalent stress relative to the back stress, and the effective modulus of the return (eq. 16).
void shift_by_back_stress(const Step& step, Chunk& chunk, std::span<Lanes, 6> back_stress, Lanes& modulus) {
  const double third = step.material.strength->kinematic_modulus() / 3.0;
  Kinematics& motion = chunk.motion;
  mask_to_solids(chunk, back_stress);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    SymmetricTensor shifted = tensor(motion.deviator, k);
    for (std::size_t j = 0; j < 6; ++j) shifted.*components[j] -= back_stress[j][k];
    motion.trial[k] = std::sqrt(1.5 * shifted.squared_norm());
    modulus[k] = motion.modulus[k] + chunk.solid_fraction[k] * third;
  }
}

template <bool stores>
void return_with_back_stress(const EosStrength& model, const Step& step, Chunk& chunk) {
  const std::span<Lanes, 6> back_stress = chunk.field<6>(model.back_stress);
  if (!any_solid(chunk)) {
    for (Lanes& lane : back_stress) std::fill_n(lane.data(), chunk.size, 0.0);
    return;
  }
  Kinematics& motion = chunk.motion;
  Lanes shifted_modulus;
  shift_by_back_stress(step, chunk, back_stress, shifted_modulus);
  find_increment(model, step, chunk, shifted_modulus);
  const double work_before = chunk.report.plastic_work;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double increment = chunk.increment[k];
    if (!(increment > 0.0)) continue;
    chunk.plastic_strain[k] += increment;
    const double stiffness = 3.0 * motion.modulus[k];
    const double per_trial = increment / motion.trial[k];
    const double hardening = step.material.strength->kinematic_modulus() * chunk.solid_fraction[k];
    double work = 0.0;  // stress : plastic strain increment
    for (std::size_t j = 0; j < 6; ++j) {
      const double shifted = motion.deviator[j][k] - back_stress[j][k];
      motion.deviator[j][k] -= stiffness * per_trial * shifted;
      back_stress[j][k] += hardening * per_trial * shifted;
      work += (j < 3 ? 1.5 : 3.0) * per_trial * motion.deviator[j][k] * shifted;
    }
    chunk.report.plastic_work += work * chunk.volume[k];
    if constexpr (stores) add_cold_work(step, chunk, chunk.history[model.stored_cold_work], k, work);
  }
  chunk.dissipate(chunk.report.plastic_work - work_before);
}

}  // namespace

void fetch_phases(const EosStrength&, const Step& in, Chunk& out) {
  out.fetch(in.points.melted_fraction, out.melted);
  out.fetch(in.points.vaporised_fraction, out.vaporised);
  out.any_melted = any_positive(out.melted, out.size);
}

void fetch_old_deviator(const EosStrength&, const Step& in, Chunk& out) {
  out.fetch(in.points.deviatoric_stress, out.old_deviator);
}

void find_solid_fraction(const EosStrength&, const Step&, Chunk& out) {
  for (std::size_t k = 0; k < out.size; ++k) {
    out.solid_fraction[k] = out.intact[k] * shear_bearing_fraction(out.melted[k], out.vaporised[k]);
  }
}

void find_damaged_solid_fraction(const EosStrength& model, const Step& in, Chunk& out) {
  find_solid_fraction(model, in, out);
  const Lanes& damage = out.history[model.damage];
  for (std::size_t k = 0; k < out.size; ++k) out.solid_fraction[k] *= 1.0 - damage[k];
}

void no_deviator(const EosStrength&, const Step&, Chunk& out) {
  clear_deviator(out);
  for (Lanes& lane : out.motion.strain) std::fill_n(lane.data(), out.size, 0.0);
}

void strain_alone(const EosStrength&, const Step& in, Chunk& out) {
  clear_deviator(out);
  find_strain(in, out);
}

void viscous_deviator(const EosStrength&, const Step& in, Chunk& out) {
  clear_deviator(out);
  viscous_stress(in, out);
  find_strain(in, out);
  const double per_twice = 0.5 / in.material.strength->viscosity();  // s:D = s:s / 2 eta
  for (std::size_t k = 0; k < out.size; ++k) {
    const double power = per_twice * tensor(out.motion.deviator, k).squared_norm();
    const double heat = power * in.settings.time_step * out.volume[k];
    out.report.dissipation += heat;
    out.report.viscous_heat += heat;
  }
}

void elastic_trial(const EosStrength& model, const Step& in, Chunk& out) {
  any_solid(out) ? find_trial(model, in, out) : no_deviator(model, in, out);
}

void elastic_trial_and_strain(const EosStrength& model, const Step& in, Chunk& out) {
  any_solid(out) ? find_trial(model, in, out) : strain_alone(model, in, out);
}

void return_radially(const EosStrength& model, const Step& in, Chunk& out) {
  if (!any_solid(out)) return;
  find_increment(model, in, out, out.motion.modulus);
  const double work = return_to_surface(out);
  out.report.plastic_work += work;
  out.dissipate(work);
}

void return_radially_and_harden(const EosStrength& model, const Step& in, Chunk& out) {
  if (!any_solid(out)) return;
  return_radially(model, in, out);
  in.material.strength->advance_threshold(out.strength_state(out.old_density, model.threshold_stress),
                                          out.view(out.increment), in.settings.time_step,
                                          out.view(out.history[model.threshold_stress]));
}

void store_cold_work(const EosStrength& model, const Step& in, Chunk& out) {
  if (!any_solid(out)) return;
  Lanes& stored = out.history[model.stored_cold_work];
  for (std::size_t k = 0; k < out.size; ++k) {
    const double increment = out.increment[k];
    const double after = std::max(0.0, out.motion.trial[k] - 3.0 * out.motion.modulus[k] * increment);
    add_cold_work(in, out, stored, k, after * increment);
  }
}

void return_kinematically(const EosStrength& model, const Step& in, Chunk& out) {
  return_with_back_stress<false>(model, in, out);
}

void return_kinematically_and_store(const EosStrength& model, const Step& in, Chunk& out) {
  return_with_back_stress<true>(model, in, out);
}

void advance_strain(const EosStrength& model, const Step&, Chunk& out) {
  const std::span<Lanes, 6> strain = out.field<6>(model.strain);
  for (std::size_t j = 0; j < 6; ++j) {
    for (std::size_t k = 0; k < out.size; ++k) strain[j][k] += out.motion.strain[j][k];
  }
}

}  // namespace whipple::material::parts

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src/device/material/failure_point.hpp"
#include "src/device/material/strength_point.hpp"
#include "src/device/material/volume_point.hpp"
#include "src/material/loss_formulas.hpp"
#include "src/particles/phases.hpp"

/// Constitutive update of one point of the symplectic scheme (docs/theory/material.md), the text of `update_material` with
/// `EosStrength` for a single point: for kernels of a graphics processor and their emulation on the host.
namespace whipple::device {

/// Holds the elastic-plastic part of the step.
struct PointReturn {
  double solid;          ///< fraction of the stiffness before the step
  double solid_modulus;  ///< shear modulus of the solid, Pa
  double modulus;        ///< with that fraction, Pa
  double increment;      ///< of the plastic strain
};

/// Advances the deviator: rotation, elastic trial, radial return.
/// @param old_density  before the step, kg/m^3
template <StrengthKind kind>
WHIPPLE_POINT inline PointReturn advance_deviator(const MaterialConstants& material, double dt,
                                                  const formulas::Matrix<double>& gradient,
                                                  double old_density, MaterialState& state,
                                                  MaterialResult& result) {
  if constexpr (kind == StrengthKind::none) {
    state.deviator = {};
    return {0.0, 0.0, 0.0, 0.0};
  }
  const double intact = state.intact() ? 1.0 : 0.0;
  const double solid = intact * shear_bearing_fraction(state.melted, state.vaporised);
  const double solid_modulus =
      solid_modulus_of<kind>(material, old_density, state.pressure, state.temperature);
  if (!(solid > 0.0)) {
    state.deviator = {};
    return {solid, solid_modulus, 0.0, 0.0};
  }
  using enum material::StressRotation;
  const double modulus = solid_modulus * solid;
  const formulas::Motion<double> motion = material.rotation == polar
                                              ? formulas::motion_of<polar>(gradient, dt)
                                              : formulas::motion_of<hughes_winget>(gradient, dt);
  const formulas::Trial<double> trial = formulas::elastic_trial(state.deviator, motion, modulus);
  const double increment = increment_by<kind>(
      material, {trial.equivalent, modulus, solid, state.plastic_strain, state.temperature}, dt);
  const double after = std::max(0.0, trial.equivalent - 3.0 * modulus * increment);
  const double kept = increment > 0.0 ? after / trial.equivalent : 1.0;
  const formulas::Symmetric<double>& s = trial.deviator;
  state.deviator = {kept * s.xx, kept * s.yy, kept * s.zz, kept * s.xy, kept * s.yz, kept * s.zx};
  state.plastic_strain += increment;
  const double work = after * increment * state.volume;
  result.plastic_work += work;
  result.dissipation += work;
  result.plastic_heat += work;
  if (material.stores_cold_work) {
    const double stored = (1.0 - material.taylor_quinney) * work;
    state.cold_work += stored / state.mass;
    result.plastic_heat -= stored;
  }
  return {solid, solid_modulus, modulus, increment};
}

/// Returns the energy that the equation of state takes, half a step ahead and without the elastic and the stored energy
/// (eq. 9, 10), J/kg.
WHIPPLE_POINT inline double energy_ahead(const MaterialConstants& material, double dt,
                                         const formulas::Matrix<double>& l, double divergence, double modulus,
                                         const MaterialState& state) {
  const formulas::Symmetric<double>& s = state.deviator;
  const double viscosity = material.heating == HeatingViscosity::not_distinguished
                               ? state.artificial_viscosity
                               : state.heating_viscosity;
  const double power = formulas::power(s, l) - (state.pressure + viscosity) * divergence;
  const double gained = 0.5 * dt * power;
  const double without_elastic =
      modulus > 0.0 ? gained - formulas::squared_norm(s) / (4.0 * modulus) : gained;
  const double energy = state.energy + without_elastic * (state.volume / state.mass);
  return material.stores_cold_work ? energy - state.cold_work : energy;
}

/// Applies the loss of strength of failed and melting points; computes the sound speed.
WHIPPLE_POINT inline void lose_strength(const MaterialConstants& material, const PointReturn& solid,
                                        double density, double bulk_sound_speed, MaterialState& state,
                                        MaterialResult& result) {
  const double least = formulas::least_sound_speed_ratio * material.reference_sound_speed;
  const double bulk = std::max(bulk_sound_speed * bulk_sound_speed, least * least);
  const bool failed = !state.intact();
  if (!failed && !(state.melted > 0.0)) {  // nothing is lost
    state.sound_speed = std::sqrt(bulk + 4.0 / 3.0 * solid.solid_modulus / density);
    return;
  }
  const formulas::LoosePoint<double> after = formulas::lose_strength<formulas::Opening::none, false, double>(
      {.porous = {state.pressure, state.volume, state.void_volume},
       .density = density,
       .melted = state.melted,
       .vaporised = state.vaporised,
       .damage = 0.0,
       .least_pressure = 0.0,
       .solid_before = solid.solid,
       .solid_modulus = solid.solid_modulus,
       .bulk = bulk,
       .viscosity = state.artificial_viscosity,
       .failed = failed},
      least * least);
  state.pressure = after.porous.pressure;
  state.volume = after.porous.volume;
  state.void_volume = after.porous.void_volume;
  state.artificial_viscosity = after.viscosity;
  state.sound_speed = std::sqrt(after.squared_sound_speed);
  if (after.limited) result.events |= event::limited_void_step;
  if (!(after.kept < 1.0)) return;
  if (solid.modulus > 0.0) {
    // A part w of the modulus that is left keeps the part w of the energy, as the stress is that of its part of the
    // material.
    const double energy = formulas::squared_norm(state.deviator) / (4.0 * solid.modulus) * state.volume;
    result.dissipation += (1.0 - after.kept * after.kept) * energy;
    result.plastic_heat += (1.0 - after.kept) * energy;
  }
  const double kept = after.kept;
  const formulas::Symmetric<double>& s = state.deviator;
  state.deviator = {kept * s.xx, kept * s.yy, kept * s.zz, kept * s.xy, kept * s.yz, kept * s.zx};
}

/// Performs the constitutive update of a point. On entry `energy` has been advanced over the step by the work of the
/// grid. The deviator, the failure and the history are those at the end of the step.
/// @param tables  numbers of all materials
/// @param velocity_gradient  L_ij = dv_i/dx_j of the new grid velocity, 1/s
/// @param affine_divergence  tr C of the affine field, 1/s, for `HeatingViscosity::of_affine_field`
template <EosKind eos_kind, StrengthKind strength_kind>
WHIPPLE_POINT inline MaterialResult update_point(const MaterialConstants& material, const double* tables,
                                                 const MaterialStep& step,
                                                 const formulas::Matrix<double>& velocity_gradient,
                                                 double affine_divergence, MaterialState& state) {
  MaterialResult result = {};
  const formulas::Matrix<double>& l = velocity_gradient;
  const PointMotion motion = {determinant(formulas::identity_plus(step.dt, l)), l.xx + l.yy + l.zz,
                              affine_divergence};
  const double old_density = state.mass / state.volume;
  result.events |= advance_volume(material, motion.ratio, state);
  const double density = state.mass / state.volume;
  advance_viscosity(material, motion, density, state);
  const PointReturn solid = advance_deviator<strength_kind>(material, step.dt, l, old_density, state, result);
  if (!state.intact() && state.void_volume > 0.0) state.artificial_viscosity = 0.0;

  const double energy = energy_ahead(material, step.dt, l, motion.divergence, solid.modulus, state);
  eos::PointState at;
  if constexpr (eos_kind == EosKind::gruneisen)
    at = evaluate_point(material.gruneisen, tables, density, energy);
  if constexpr (eos_kind == EosKind::table) at = evaluate_point(material.table, tables, density, energy);
  result.events |= at.events;
  const double solid_before = shear_bearing_fraction(state.melted, state.vaporised);
  state.pressure = at.pressure;
  state.temperature = at.temperature;
  if constexpr (eos_kind == EosKind::table) {
    state.melted = at.melted;
    state.vaporised = at.vaporised;
  }
  if ((material.criteria > 0 || material.voids != VoidKind::none) &&
      update_failure(material, {step.dt, density, at.sound_speed, solid.increment, motion.divergence},
                     state)) {
    result.events |= event::newly_failed;
  }
  lose_strength(material, solid, density, at.sound_speed, state, result);
  if (material.stores_cold_work) {
    const double bearing = shear_bearing_fraction(state.melted, state.vaporised);
    if (bearing < solid_before) {
      const double left = state.cold_work * (bearing / solid_before);
      result.plastic_heat += (state.cold_work - left) * state.mass;
      state.cold_work = left;
    }
  }
  result.compression_rate = state.pressure > 0.0 ? -motion.divergence : 0.0;
  if (state.pressure > state.maximum_pressure) state.maximum_pressure = state.pressure;
  if (state.temperature > state.maximum_temperature) state.maximum_temperature = state.temperature;
  if (state.melted >= melted_share && state.melting_time == never) state.melting_time = step.time;
  return result;
}

/// Performs the update of a material of any kind, for the host.
inline MaterialResult update_point(const MaterialConstants& material, const double* tables,
                                   const MaterialStep& step, const formulas::Matrix<double>& gradient,
                                   double affine_divergence, MaterialState& state) {
  const auto with_strength = [&]<EosKind kind>() {
    switch (material.strength) {
      case StrengthKind::none:
        return update_point<kind, StrengthKind::none>(material, tables, step, gradient, affine_divergence,
                                                      state);
      case StrengthKind::von_mises:
        return update_point<kind, StrengthKind::von_mises>(material, tables, step, gradient,
                                                           affine_divergence, state);
      case StrengthKind::johnson_cook:
        return update_point<kind, StrengthKind::johnson_cook>(material, tables, step, gradient,
                                                              affine_divergence, state);
      case StrengthKind::steinberg_guinan:
        return update_point<kind, StrengthKind::steinberg_guinan>(material, tables, step, gradient,
                                                                  affine_divergence, state);
    }
    return MaterialResult{};
  };
  return material.eos == EosKind::table ? with_strength.template operator()<EosKind::table>()
                                        : with_strength.template operator()<EosKind::gruneisen>();
}

}  // namespace whipple::device

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/chunk.hpp"
#include "src/material/kinematic_formulas.hpp"

/// Parts of the constitutive update that are common to all models (docs/theory/material.md, sections 1 and 4).
namespace whipple::material {

/// Collects the points of a chunk: state, velocity gradient, history convected over the step.
void gather(const Step& step, Chunk& chunk);
/// Writes the chunk back to its points.
void scatter(const Step& step, Chunk& chunk, MaterialPoints& points);

/// Advances the volumes of material and void (eq. 1, eq. 11): the total follows J; voids take part of the change until
/// they are closed.
void advance_volume(const Step& step, Chunk& chunk);
/// Computes the density at the end of the step and the artificial viscosity (eq. 8).
void advance_viscosity(const Step& step, Chunk& chunk);
/// Updates the maximum compression rate, which bounds the next time step; points without pressure, where only a void
/// closes, are excluded.
void find_compression_rate(const Step& step, Chunk& chunk);

/// Computes the energy (J/kg) that the equation of state receives in the symplectic scheme: half a step ahead of
/// e^{n+1}, so that pressure and stresses are those at the end of the step, and without the elastic energy (eq. 9, 10).
/// @param without_elastic  without_elastic(k, s, gained): `gained` (J/m^3) minus the elastic energy of point k with the
/// deviator s
template <class WithoutElastic>
inline void energy_ahead(const Step& step, Chunk& chunk, WithoutElastic without_elastic) {
  const double half_step = 0.5 * step.settings.time_step;
  const SymmetricLanes& lanes = chunk.motion.deviator;
  const MatrixLanes& l = chunk.motion.gradient;
  const Lanes& viscosity =
      step.distinguishes_heating() ? chunk.heating_viscosity : chunk.artificial_viscosity;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const SymmetricTensor s = tensor(lanes, k);
    const auto deviatoric = formulas::power<double>(
        {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx},
        {l[0][k], l[1][k], l[2][k], l[3][k], l[4][k], l[5][k], l[6][k], l[7][k], l[8][k]});
    const double power = deviatoric - (chunk.pressure[k] + viscosity[k]) * chunk.motion.divergence[k];
    const double specific_volume = chunk.volume[k] / chunk.mass[k];
    chunk.energy[k] =
        chunk.specific_internal_energy[k] + without_elastic(k, s, half_step * power) * specific_volume;
  }
}
/// Prepares the energy step of schemes without a work identity (eq. 14), e = e_0 - h p(e): e_0 contains all work except
/// that of the new pressure, and h = dV / 2m. Uses `old_deviator` and the strain increments of the step.
void work_without_new_pressure(const Step& step, Chunk& chunk);

/// Evaluates the equation of state for `energy`, or solves the energy step that was prepared for it: sets new pressure,
/// temperature and bulk sound speed; the acting pressure equals the pressure.
/// @tparam phases      whether the equation of state has phases: sets new `melted` and `vaporised`
/// @param distension   of porous material, otherwise empty
template <bool phases>
void evaluate_equation_of_state(const Step& step, Chunk& chunk, std::span<double> distension = {}) {
  eos::Batch batch{chunk.view(chunk.density),
                   chunk.view(chunk.energy),
                   chunk.view(chunk.pressure),
                   chunk.view(chunk.temperature),
                   chunk.view(chunk.bulk_sound_speed),
                   {},
                   {}};
  if constexpr (phases) {
    batch.melted_fraction = chunk.view(chunk.melted);
    batch.vaporised_fraction = chunk.view(chunk.vaporised);
  }
  batch.distension = distension;
  const eos::EquationOfState& model = *step.material.eos;
  book(chunk, step.energy == Energy::from_grid
                  ? model.evaluate(batch)
                  : model.integrate(batch, chunk.view(chunk.energy), chunk.view(chunk.half_change)));
  std::copy_n(chunk.pressure.data(), chunk.size, chunk.acting_pressure.data());
}

/// Completes the energy step of a model whose elastic energy is not part of the energy of the equation of state
/// (without phases and pores): evaluates the equation of state for the energy minus `elastic_energy`. Requires the new
/// deviator.
/// @param elastic_pressure  Pa, of the elastic energy, which adds to that of the equation of state
void solve_energy(const Step& step, const Lanes& elastic_pressure, Chunk& chunk);

}  // namespace whipple::material

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/eos_strength/eos_strength.hpp"

/// Parts of the update by equation of state, strength and failure, in the order in which they follow one another. Names
/// say what a part is for; which of several variants a material takes is decided in eos_strength.cpp.
namespace whipple::material::parts {

// ---- start of the step (deviator.cpp)
/// Collects the phase fractions.
void fetch_phases(const EosStrength& model, const Step& in, Chunk& out);
/// Collects the old deviator, for the work of the step.
void fetch_old_deviator(const EosStrength& model, const Step& in, Chunk& out);
/// Determines the fraction of the stiffness that a point still has: that of the solid, 0 where it has failed.
void find_solid_fraction(const EosStrength& model, const Step& in, Chunk& out);
/// The same, less the damage.
void find_damaged_solid_fraction(const EosStrength& model, const Step& in, Chunk& out);

// ---- deviator (deviator.cpp): rotation, elastic trial, radial return (eq. 3 to 7, 16)
/// No deviator, no strain.
void no_deviator(const EosStrength& model, const Step& in, Chunk& out);
/// No deviator, but the strain increment.
void strain_alone(const EosStrength& model, const Step& in, Chunk& out);
/// Newtonian fluid: s = 2 eta dev D, without elastic energy.
void viscous_deviator(const EosStrength& model, const Step& in, Chunk& out);
/// Elastic trial; of a chunk without solids, as `no_deviator`.
void elastic_trial(const EosStrength& model, const Step& in, Chunk& out);
/// Elastic trial; of a chunk without solids, as `strain_alone`.
void elastic_trial_and_strain(const EosStrength& model, const Step& in, Chunk& out);
/// Radial return with isotropic hardening.
void return_radially(const EosStrength& model, const Step& in, Chunk& out);
/// The same, and advances the threshold stress (eq. 31).
void return_radially_and_harden(const EosStrength& model, const Step& in, Chunk& out);
/// Adds the part of the plastic work of `return_radially` that does not become heat to the cold work (eq. 24).
void store_cold_work(const EosStrength& model, const Step& in, Chunk& out);
/// Radial return with a back stress (eq. 16).
void return_kinematically(const EosStrength& model, const Step& in, Chunk& out);
/// The same, and stores cold work.
void return_kinematically_and_store(const EosStrength& model, const Step& in, Chunk& out);
/// Logarithmic strain, rotated with the material (eq. 17).
void advance_strain(const EosStrength& model, const Step& in, Chunk& out);

// ---- energy and equation of state (energy.cpp)
/// Takes the artificial viscosity from failed points beside an open void.
void free_failed(const EosStrength& model, const Step& in, Chunk& out);
/// Takes the artificial viscosity from all points beside an open void.
void free_brittle(const EosStrength& model, const Step& in, Chunk& out);
/// Prepares the energy of the equation of state, by the way in which the energy of the step is known.
void energy_from_grid(const EosStrength& model, const Step& in, Chunk& out);
void energy_by_work(const EosStrength& model, const Step& in, Chunk& out);
/// Takes the cold work out of the energy of the equation of state.
void take_cold_work(const EosStrength& model, const Step& in, Chunk& out);
/// Evaluates the equation of state: with or without phases, with or without pores.
void evaluate_simple(const EosStrength& model, const Step& in, Chunk& out);
void evaluate_phases(const EosStrength& model, const Step& in, Chunk& out);
void evaluate_porous(const EosStrength& model, const Step& in, Chunk& out);
void evaluate_porous_phases(const EosStrength& model, const Step& in, Chunk& out);
/// Makes the solved energy that of the points; with the cold work.
void accept_energy(const EosStrength& model, const Step& in, Chunk& out);
void return_cold_work(const EosStrength& model, const Step& in, Chunk& out);

// ---- failure (failure.cpp, brittle.cpp)
/// Strength, damage and bulking of brittle material (docs/theory/concrete_and_ceramics.md).
void relax_brittle(const EosStrength& model, const Step& in, Chunk& out);
/// Prepares what the criteria take.
void prepare_failure(const EosStrength& model, const Step& in, Chunk& out);
/// Makes failed points whole again whose void pressure has closed.
void heal(const EosStrength& model, const Step& in, Chunk& out);
/// Lets voids grow in porous material (eq. 20 to 22, 25, 26).
void grow_voids(const EosStrength& model, const Step& in, Chunk& out);
/// Evaluates the failure criteria; with the strain.
void mark_failed(const EosStrength& model, const Step& in, Chunk& out);
void mark_failed_by_strain(const EosStrength& model, const Step& in, Chunk& out);

// ---- loss of strength and sound speed (loss.cpp)
/// Divides the volume between material and voids and takes the deviator from what has failed or melts; sound speed.
void lose_in_failed(const EosStrength& model, const Step& in, Chunk& out);
/// The same, where damage opens cracks and softens.
void lose_in_damaged(const EosStrength& model, const Step& in, Chunk& out);
/// The same of brittle material, whose gaps open at a tension.
void lose_in_brittle(const EosStrength& model, const Step& in, Chunk& out);
/// The same of fluids with viscosity, whose stress knows nothing of phases.
void lose_in_viscous(const EosStrength& model, const Step& in, Chunk& out);
void lose_in_damaged_viscous(const EosStrength& model, const Step& in, Chunk& out);
/// Takes from the back stress what the deviator has lost.
void lose_back_stress(const EosStrength& model, const Step& in, Chunk& out);
/// Converts the stored cold work of melting points to heat.
void release_cold_work(const EosStrength& model, const Step& in, Chunk& out);
/// Corrects the work of the step for points that act with less than the pressure of the equation of state (eq. 15).
void correct_work_beside_voids(const EosStrength& model, const Step& in, Chunk& out);

}  // namespace whipple::material::parts

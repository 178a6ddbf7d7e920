// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/eos_strength/eos_strength.hpp"

/// Parts of the update by equation of state, strength and failure, in the order of the update. eos_strength.cpp selects
/// the variants for a material.
namespace whipple::material::parts {

// ---- start of the step (deviator.cpp)
/// Collects the phase fractions.
void fetch_phases(const EosStrength& model, const Step& in, Chunk& out);
/// Collects the old deviator, for the work of the step.
void fetch_old_deviator(const EosStrength& model, const Step& in, Chunk& out);
/// Determines the fraction of the stiffness that a point retains: that of the solid, 0 where it has failed.
void find_solid_fraction(const EosStrength& model, const Step& in, Chunk& out);
/// Determines the same fraction, multiplied by 1 - damage.
void find_damaged_solid_fraction(const EosStrength& model, const Step& in, Chunk& out);

// ---- deviator (deviator.cpp): rotation, elastic trial, radial return (eq. 3 to 7, 16)
/// Sets deviator and strain to zero.
void no_deviator(const EosStrength& model, const Step& in, Chunk& out);
/// Sets the deviator to zero and computes the strain increment.
void strain_alone(const EosStrength& model, const Step& in, Chunk& out);
/// Computes the stress of a Newtonian fluid, s = 2 eta dev D, which has no elastic energy.
void viscous_deviator(const EosStrength& model, const Step& in, Chunk& out);
/// Computes the elastic trial; for a chunk without solids as `no_deviator`.
void elastic_trial(const EosStrength& model, const Step& in, Chunk& out);
/// Computes the elastic trial; for a chunk without solids as `strain_alone`.
void elastic_trial_and_strain(const EosStrength& model, const Step& in, Chunk& out);
/// Performs the radial return with isotropic hardening.
void return_radially(const EosStrength& model, const Step& in, Chunk& out);
/// Performs the radial return and advances the threshold stress (eq. 31).
void return_radially_and_harden(const EosStrength& model, const Step& in, Chunk& out);
/// Adds the part of the plastic work of `return_radially` that does not become heat to the cold work (eq. 24).
void store_cold_work(const EosStrength& model, const Step& in, Chunk& out);
/// Performs the radial return with a back stress (eq. 16).
void return_kinematically(const EosStrength& model, const Step& in, Chunk& out);
/// Performs the radial return with a back stress and stores cold work.
void return_kinematically_and_store(const EosStrength& model, const Step& in, Chunk& out);
/// Advances the logarithmic strain, rotated with the material (eq. 17).
void advance_strain(const EosStrength& model, const Step& in, Chunk& out);

// ---- energy and equation of state (energy.cpp)
/// Removes the artificial viscosity of failed points with an open void.
void free_failed(const EosStrength& model, const Step& in, Chunk& out);
/// Removes the artificial viscosity of all points with an open void.
void free_brittle(const EosStrength& model, const Step& in, Chunk& out);
/// Prepare the energy of the equation of state, from the grid or from the work of the stresses.
void energy_from_grid(const EosStrength& model, const Step& in, Chunk& out);
void energy_by_work(const EosStrength& model, const Step& in, Chunk& out);
/// Subtracts the cold work from the energy of the equation of state.
void take_cold_work(const EosStrength& model, const Step& in, Chunk& out);
/// Evaluate the equation of state: with or without phases, with or without pores.
void evaluate_simple(const EosStrength& model, const Step& in, Chunk& out);
void evaluate_phases(const EosStrength& model, const Step& in, Chunk& out);
void evaluate_porous(const EosStrength& model, const Step& in, Chunk& out);
void evaluate_porous_phases(const EosStrength& model, const Step& in, Chunk& out);
/// Evaluates the equation of state, crushes the foam to its yield surface, and evaluates it again with the new distension
/// (docs/theory/foam.md).
void evaluate_foam(const EosStrength& model, const Step& in, Chunk& out);
/// Evaluates the equation of state, changes the distension by the flow of soil, and evaluates it again
/// (docs/theory/soil.md, section 3).
void evaluate_dilating(const EosStrength& model, const Step& in, Chunk& out);
/// Set the energy of the points to the solved one; the second adds the cold work.
void accept_energy(const EosStrength& model, const Step& in, Chunk& out);
void return_cold_work(const EosStrength& model, const Step& in, Chunk& out);

/// Holds the state before the equation of state of a step was evaluated with a distension that its flow changes.
class TrialEvaluation {
 public:
  explicit TrialEvaluation(const Chunk& chunk) : pressure_(chunk.pressure), report_(chunk.report) {}
  /// Evaluates it again, for the same step, with the stress and the distension that it ends with; the trial state is not
  /// reported.
  void repeat(const EosStrength& model, const Step& in, Chunk& out) const;

 private:
  Lanes pressure_;
  MaterialReport report_;
};

// ---- failure (failure.cpp, brittle.cpp)
/// Updates strength, damage and bulking of brittle material (docs/theory/concrete_and_ceramics.md).
void relax_brittle(const EosStrength& model, const Step& in, Chunk& out);
/// Prepares the input of the criteria.
void prepare_failure(const EosStrength& model, const Step& in, Chunk& out);
/// Heals failed points whose void has been closed by pressure.
void heal(const EosStrength& model, const Step& in, Chunk& out);
/// Grows voids in porous material (eq. 20 to 22, 25, 26).
void grow_voids(const EosStrength& model, const Step& in, Chunk& out);
/// Evaluate the failure criteria; the second with the strain.
void mark_failed(const EosStrength& model, const Step& in, Chunk& out);
void mark_failed_by_strain(const EosStrength& model, const Step& in, Chunk& out);
/// Keeps the size of the fragments of points that fail, and forgets that of points that heal.
void keep_fragment_size(const EosStrength& model, const Step& in, Chunk& out);

// ---- loss of strength and sound speed (loss.cpp)
/// Divides the volume between material and voids, reduces the deviator of failed and melting points, and computes the
/// sound speed.
void lose_in_failed(const EosStrength& model, const Step& in, Chunk& out);
/// Performs the same for materials in which damage opens cracks and softens.
void lose_in_damaged(const EosStrength& model, const Step& in, Chunk& out);
/// Performs the same for brittle material, whose voids open at a tension.
void lose_in_brittle(const EosStrength& model, const Step& in, Chunk& out);
/// Perform the same for viscous fluids, whose stress does not depend on phases; the second also with damage.
void lose_in_viscous(const EosStrength& model, const Step& in, Chunk& out);
void lose_in_damaged_viscous(const EosStrength& model, const Step& in, Chunk& out);
/// Scales the back stress like the deviator.
void lose_back_stress(const EosStrength& model, const Step& in, Chunk& out);
/// Converts the stored cold work of melting points to heat.
void release_cold_work(const EosStrength& model, const Step& in, Chunk& out);
/// Corrects the work of the step for points whose acting pressure is below that of the equation of state (eq. 15).
void correct_work_beside_voids(const EosStrength& model, const Step& in, Chunk& out);

}  // namespace whipple::material::parts

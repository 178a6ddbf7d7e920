// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/transfer_control.hpp"

#include <fmt/format.h>

#include "src/case/case.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple::cases {

ParameterTable<TransferControl> TransferControl::parameters() {
  return {
      choice("shape_function", &TransferControl::shape_function,
             "shape functions of the transfers between particles and nodes")
          .optional(),
      real("slope_smoothing", &TransferControl::slope_smoothing, "", range::between(0.0, 2.0),
           "a1 of the slopes of quadratic B-splines in forces and strain rates: 0 gives the derivatives of "
           "the "
           "functions, larger values less heat in material that crosses cells and more pressure noise "
           "elsewhere")
          .optional(),
      choice("particle_update", &TransferControl::particle_update,
             "velocity transfer to the particles; default of schemes other than symplectic: flip")
          .optional("\"relaxed_affine\""),
      real("kappa", &TransferControl::kappa, "", range::non_negative(),
           "relaxation of the affine field: beta = 1 - exp(-kappa c dt / dx)")
          .optional(),
      choice(
          "affine_field", &TransferControl::affine_field,
          "affine velocity field convected with the deformation of the step (debris clouds) | corotated only "
          "(rotating and vibrating bodies)")
          .optional(),
      real("flip_fraction", &TransferControl::flip_fraction, "", range::between(0.0, 1.0),
           "fraction of FLIP in particle_update \"blend\"; the remainder is PIC")
          .optional(),
      integer("fmpm_order", &TransferControl::fmpm_order, range::between(1, 20),
              "k of particle_update \"fmpm\": number of terms of the inverse of the full mass matrix")
          .optional(),
      boolean("random_shift", &TransferControl::random_shift,
              "shift the grid by a random fraction of a cell in every step, along axes without walls")
          .optional(),
      integer("random_seed", &TransferControl::random_seed, range::between(0, 1e9), "seed of random_shift")
          .optional(),
      boolean("free_flight", &TransferControl::free_flight,
              "failed particles without stress and neighbours move ballistically, without the grid")
          .optional(),
      real("rest_tolerance", &TransferControl::rest_tolerance, "", range::between(0.0, 1e-6),
           "blocks with velocities below this fraction of the sound speed c and stresses below this fraction "
           "of "
           "rho c^2 are inactive until a wave reaches them; 0: never")
          .optional()};
}

void TransferControl::check(const Case& setup, const Faults& faults) const {
  const bool exact = setup.time.scheme == Scheme::symplectic;
  if (!exact && is_affine(particle_update)) {
    faults.add("particle_update",
               fmt::format("scheme \"{}\" carries no affine field: it works with particle_update = "
                           "\"flip\", \"pic\", \"blend\" or \"fmpm\"; \"{}\" needs \"symplectic\"",
                           word_of(setup.time.scheme), word_of(particle_update)));
  }
  if (exact && particle_update == ParticleUpdate::fmpm) {
    faults.add("particle_update",
               "particle_update = \"fmpm\" has no exact energy balance, which scheme \"symplectic\" "
               "keeps: it works with scheme = \"usl\", \"musl\" or \"usf\"");
  }
  if (exact && is_affine(particle_update) && !transfer::carries_affine_field(shape_function)) {
    faults.add("shape_function",
               fmt::format("particle_update = \"{}\" needs functions whose second moment is the same "
                           "everywhere: shape_function = \"quadratic_bspline\" or \"cubic_bspline\"; \"{}\" "
                           "works with \"flip\", \"pic\", \"blend\" (and \"fmpm\" in schemes other than "
                           "symplectic)",
                           word_of(particle_update), word_of(shape_function)));
  }
}

}  // namespace whipple::cases

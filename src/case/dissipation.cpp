// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/dissipation.hpp"

#include <fmt/format.h>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Dissipation> Dissipation::parameters() {
  return {choice("losses", &Dissipation::losses,
                 "kinetic energy that the transfers lose is unresolved motion until viscosity or a closing "
                 "gap makes it heat; shocks conduct heat | it is heat at once, as in other codes: for "
                 "comparison. Schemes other than symplectic: \"heat\"")
              .optional("\"unresolved\""),
          real("heat_share", &Dissipation::heat_share, "", range::non_negative(),
               "losses of a particle become heat up to this share of the work of its artificial viscosity")
              .optional(),
          real("collision_rate", &Dissipation::collision_rate, "", range::non_negative(),
               "share of the unresolved energy of loose matter that becomes heat, per share of its volume "
               "that closes")
              .optional(),
          real("affine_gain", &Dissipation::affine_gain, "", range::non_negative(),
               "artificial viscosity heats by the rate of closing of the particle's affine field times this, "
               "the rest of its work is unresolved")
              .optional(),
          real("affine_compression", &Dissipation::affine_compression, "", range::non_negative(),
               "compression from the start over which that goes over to all of its work; 0: all of it always "
               "heats")
              .optional(),
          real("shock_conduction", &Dissipation::shock_conduction, "", range::non_negative(),
               "diffusivity of heat inside shocks over that of the artificial viscosity")
              .optional(),
          real("conduction_onset", &Dissipation::conduction_onset, "", range::non_negative(),
               "closing speed over a cell, as a share of the speed of sound, from which on a shock conducts")
              .optional(),
          real("conduction_rise", &Dissipation::conduction_rise, "", range::positive(),
               "further closing speed over which its conduction grows to the full one")
              .optional()};
}

/// Only the work identity of the symplectic scheme says what the transfers lose.
void Dissipation::check(const Case& setup, const Faults& faults) const {
  if (setup.time.scheme == Scheme::symplectic || !keeps_losses()) return;
  faults.add("losses", fmt::format("losses = \"unresolved\" needs scheme = \"symplectic\": \"{}\" does not know "
                                   "what its transfers lose",
                                   word_of(setup.time.scheme)));
}

}  // namespace whipple::cases

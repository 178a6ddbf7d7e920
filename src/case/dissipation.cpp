// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/dissipation.hpp"

#include <fmt/format.h>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Dissipation> Dissipation::parameters() {
  return {
      choice("losses", &Dissipation::losses,
             "kinetic energy lost in transfers is unresolved motion until viscosity or a closing gap "
             "converts it "
             "to heat, with heat conduction inside shocks | converted to heat immediately, as in other "
             "codes, for "
             "comparison. Default of schemes other than symplectic: \"heat\"")
          .optional("\"unresolved\""),
      real("heat_share", &Dissipation::heat_share, "", range::non_negative(),
           "losses of a particle are converted to heat up to this fraction of its artificial viscous work")
          .optional(),
      real("allowance_time", &Dissipation::allowance_time, "", range::non_negative(),
           "time over which the viscous work still counts for heat_share, in transits of sound through a "
           "cell; 0: only the step itself")
          .optional(),
      real("collision_rate", &Dissipation::collision_rate, "", range::non_negative(),
           "fraction of the unresolved energy of fragmented material converted to heat, per fraction of "
           "volume "
           "that closes")
          .optional(),
      real("affine_gain", &Dissipation::affine_gain, "", range::non_negative(),
           "artificial viscosity heats with the closing rate of the affine field of the particle times this "
           "factor; the remaining work is unresolved")
          .optional(),
      real("affine_compression", &Dissipation::affine_compression, "", range::non_negative(),
           "compression from the initial state over which the heat increases to all of its work; 0: always "
           "all of it")
          .optional(),
      real("shock_conduction", &Dissipation::shock_conduction, "", range::non_negative(),
           "heat diffusivity inside shocks over that of the artificial viscosity")
          .optional(),
      real("conduction_onset", &Dissipation::conduction_onset, "", range::non_negative(),
           "closing speed over a cell, as a fraction of the sound speed, above which a shock conducts heat")
          .optional(),
      real("conduction_rise", &Dissipation::conduction_rise, "", range::positive(),
           "additional closing speed at which the conduction reaches its full value")
          .optional()};
}

/// Adds a fault unless the scheme is symplectic: only its work identity yields the losses of the transfers.
void Dissipation::check(const Case& setup, const Faults& faults) const {
  if (setup.time.scheme == Scheme::symplectic || !keeps_losses()) return;
  faults.add("losses",
             fmt::format("losses = \"unresolved\" needs scheme = \"symplectic\": \"{}\" does not know "
                         "what its transfers lose",
                         word_of(setup.time.scheme)));
}

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/artificial_viscosity.hpp"

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<ArtificialViscosity> ArtificialViscosity::parameters() {
  return {real("linear", &ArtificialViscosity::linear, "", range::non_negative(),
               "c1 of q = rho l |D| (c2 l |D| + c1 c), in compression")
              .optional(),
          real("quadratic", &ArtificialViscosity::quadratic, "", range::non_negative(), "c2 of the same")
              .optional(),
          real("expansion", &ArtificialViscosity::expansion, "", range::non_negative(),
               "c1 of q = -rho l |D| c1 c in expansion, limited to the pressure: damps the overshoot of a "
               "shock at a free "
               "surface; 0: none")
              .optional()};
}

const ArtificialViscosity& ArtificialViscosity::inherited(const Case& setup) { return setup.viscosity; }

}  // namespace whipple::cases

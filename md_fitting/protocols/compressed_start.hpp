// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "md_fitting/lammps/potential.hpp"

namespace whipple::md {

/// Describes the initial crystal of a run at constant pressure.
struct CompressedStart {
  double lattice_constant = 0.0;  ///< A, of the static crystal
  double volume_ratio = 1.0;      ///< relative to the static crystal at zero pressure
};

/// Returns the static crystal at a pressure (Pa) if it is shorter than that at zero pressure by more than 3 %, and
/// that at zero pressure otherwise: a barostat can change a crystal over small distances, whereas a jump of 50 GPa
/// heats and destroys it. Collective over the team of the point.
/// @throws StateError if the crystal does not reach the pressure at the smallest volume of the potential, or V/V0 = 0.4
CompressedStart compressed_start(const Potential& potential, double pressure);

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"

namespace whipple::md {

/// Holds a static crystal at one volume. Exact for the potential: no statistical error.
struct ColdState {
  double pressure = 0.0;                  ///< Pa; for hcp at the axial ratio of minimum energy
  double specific_internal_energy = 0.0;  ///< J/kg
  double axial_ratio = 0.0;               ///< c/a of hcp at minimum energy; 0 for cubic crystals
};

/// Computes the static crystal at a specific volume.
/// @param structure fcc, bcc or hcp
/// @param transcript the LAMMPS commands are appended to it
/// @throws StateError if an hcp crystal has no energy minimum over the axial ratio near the ideal one.
ColdState measure_cold(const Potential& potential, CrystalStructure structure, double specific_volume,
                       std::string& transcript);

}  // namespace whipple::md

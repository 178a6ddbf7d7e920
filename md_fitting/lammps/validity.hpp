// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>

#include "md_fitting/lammps/eam_tables.hpp"

namespace whipple::md {

/// Holds the pressure up to which states of a potential are not flagged, and the reason for the limit. States are
/// rejected only at the hard limit of `Potential::require_range`.
struct Validity {
  double pressure =
      std::numeric_limits<double>::infinity();  ///< Pa, of the static crystal; infinite: no known limit
  std::string reason;                           ///< "hcp has less energy than fcc"
};

/// Returns the lowest pressure of the static crystal at which one of these holds: another structure (fcc, bcc, or hcp
/// of the ideal axial ratio) has less energy at the same volume by more than 1 meV per atom; the density exceeds that
/// to which the embedding function was fitted, where known; the limit of the admissible volumes is reached.
/// @param least_volume_ratio  V/V0 at which states are rejected
Validity validity_of(const EamTables& tables, double least_volume_ratio);

}  // namespace whipple::md

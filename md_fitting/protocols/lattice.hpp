// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/lammps/potential.hpp"

namespace whipple::md {

/// Holds the static crystal at zero pressure as computed by LAMMPS. The stated errors are those of the root search;
/// there are no statistical errors.
struct LatticeResult : LatticePoint {
  std::string transcript;
};
LatticeResult measure_lattice(const Potential& potential);

}  // namespace whipple::md

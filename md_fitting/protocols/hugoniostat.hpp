// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/protocols/hugoniot.hpp"

namespace whipple::md {

struct HugoniostatResult : HugoniostatPoint {
  int parts = 0;  ///< parts of the equilibration that were needed
  std::string transcript;
};

/// Computes the state behind a steady shock of a given pressure by a thermostat and barostat that drive a crystal
/// to the Hugoniot (Ravelo, Holian, Germann, Lomdahl, Phys. Rev. B 70 (2004) 014103; LAMMPS' fix nphug, isotropic):
/// a method independent of `solve_hugoniot`.
HugoniostatResult run_hugoniostat(const Potential& potential, const ReferenceState& reference,
                                  double pressure, const RunSize& size, std::int64_t seed);

}  // namespace whipple::md

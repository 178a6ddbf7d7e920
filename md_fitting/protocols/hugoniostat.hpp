// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/protocols/hugoniot.hpp"

namespace whipple::md {

struct HugoniostatResult {
  Estimate pressure;                  ///< Pa
  Estimate specific_volume;           ///< m^3/kg
  Estimate temperature;               ///< K
  Estimate specific_internal_energy;  ///< J/kg
  Estimate shock_velocity;            ///< m/s; the error includes the effect of the residual
  Estimate particle_velocity;         ///< m/s, likewise
  Estimate residual_temperature;      ///< K, residual of equation 8 over 3k/m
  double crystal_share = 0.0;         ///< after minimisation to the nearest minimum of the energy
  int parts = 0;                      ///< parts of the equilibration that were needed
  bool converged = false;
  std::string transcript;
};

/// Computes the state behind a steady shock of a given pressure by a thermostat and barostat that drive a crystal
/// to the Hugoniot (Ravelo, Holian, Germann, Lomdahl, Phys. Rev. B 70 (2004) 014103; LAMMPS' fix nphug, isotropic):
/// a method independent of `solve_hugoniot`.
HugoniostatResult run_hugoniostat(const Potential& potential, const ReferenceState& reference,
                                  double pressure, const RunSize& size, std::int64_t seed);

}  // namespace whipple::md

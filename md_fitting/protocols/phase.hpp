// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/protocols/crystal.hpp"

namespace whipple::md {

/// Factor on the target temperature at which a crystal is melted to prepare a melt.
inline constexpr double overheating = 2.5;

/// Melts a crystal at constant volume by overheating, then brings the melt to the temperature, with the time step
/// dt (ps).
void make_melt(Crystal& crystal, double temperature, double dt, std::int64_t seed);

/// Holds one phase at constant pressure and temperature.
struct Phase {
  Estimate volume;    ///< A^3 per atom
  Estimate enthalpy;  ///< eV per atom, without the kinetic part
  Estimate energy;    ///< eV per atom, without the kinetic part
  double crystal_share = 0.0;
};

/// Measures one phase in a separate cell.
/// @param liquid     a melt, prepared by `overheating` at constant volume; otherwise a crystal
/// @param pressure   Pa
/// @param size       cells along each edge, equilibration steps and averaged steps
/// @param dt         ps
/// @param transcript the LAMMPS commands are appended to it
Phase measure_phase(const Potential& potential, bool liquid, double pressure, double temperature,
                    const RunSize& size, double dt, std::int64_t seed, std::string& transcript);

}  // namespace whipple::md

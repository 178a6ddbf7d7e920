// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/run_size.hpp"
#include "md_fitting/protocols/crystal.hpp"

namespace whipple::md {

/// A melt is made from a crystal at this multiple of the temperature at which it is wanted.
inline constexpr double overheating = 2.5;

/// Melts a crystal at constant volume by overheating and leaves the melt at the temperature, with the time
/// step dt (ps).
void make_melt(Crystal& crystal, double temperature, double dt, std::int64_t seed);

/// One phase alone at constant pressure and temperature.
struct Phase {
  Estimate volume;    ///< A^3 per atom
  Estimate enthalpy;  ///< eV per atom, without the kinetic part
  Estimate energy;    ///< eV per atom, without the kinetic part
  double crystal_share = 0.0;
};

/// @param liquid     a melt, made by `overheating` at constant volume; otherwise a crystal
/// @param pressure   Pa
/// @param size       cells along each edge, steps to settle and steps that are averaged
/// @param dt         ps
/// @param transcript the LAMMPS commands are added to it
Phase measure_phase(const Potential& potential, bool liquid, double pressure, double temperature,
                    const RunSize& size, double dt, std::int64_t seed, std::string& transcript);

}  // namespace whipple::md

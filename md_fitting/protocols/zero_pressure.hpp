// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/plan.hpp"

namespace whipple::md {

struct ZeroPressureResult : ZeroPressurePoint {
  std::string transcript;
  std::vector<double> volume_blocks{};  ///< m^3/kg, means over parts of the averaged time
};

/// Returns (1/V) dV/dT from the joint fluctuations of volume and potential energy at zero pressure and constant
/// temperature, <dV dU>/(k T^2 V) (Allen, Tildesley, Computer Simulation of Liquids, 2nd ed., section 2.5).
/// @param volume,energy per atom, A^3 and eV
Estimate thermal_expansion(std::span<const double> volume, std::span<const double> energy, double atoms,
                           double temperature);

/// Measures volume and energy of the crystal at a temperature and zero pressure, at constant pressure and
/// temperature (Langevin bath, Nose-Hoover barostat, isotropic). Thermal expansion and thermal energy are scaled by
/// N/(N - 1), as in `NvtStateSource`.
/// @throws StateError if the crystal melted.
ZeroPressureResult measure_zero_pressure(const Potential& potential, double temperature, const RunSize& size,
                                         std::int64_t seed);

}  // namespace whipple::md

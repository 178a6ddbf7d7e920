// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/plan.hpp"

namespace whipple::md {

struct ZeroPressureResult {
  Estimate specific_volume;           ///< m^3/kg
  Estimate specific_internal_energy;  ///< J/kg
  std::string transcript;
};

/// Volume and energy of the crystal at a temperature and zero pressure, at constant pressure and temperature
/// (Nose-Hoover thermostat and barostat, isotropic). Thermal expansion and thermal energy are scaled by N/(N
/// - 1), as those of `NvtStateSource`.
/// @throws StateError if the crystal melted.
ZeroPressureResult measure_zero_pressure(const Potential& potential, double temperature, const RunSize& size,
                                         std::int64_t seed);

}  // namespace whipple::md

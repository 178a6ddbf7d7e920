// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/fit_result.hpp"

/// Fits equations of state of a solid without phase changes, by the same least-squares problem as GRAY
/// (docs/theory/fit.md, section 7).
namespace whipple::fit {

/// Fits rho0, c0, s, Gamma0, b of rho Gamma = rho0 (Gamma0 + b mu), and a constant heat capacity.
/// @throws InputError, StateError as fit_gray
Fit fit_mie_gruneisen(std::span<const md::PointRecord> points, const FitSettings& settings,
                      const std::string& store_name);

/// Fits rho0, K0 and K0' of Vinet's isotherm, gamma0 and a of the linear law, and with coexistence points T_m0. The
/// Debye temperature, which classical nuclei do not determine, comes from the elastic constants in the database or
/// from the element's table.
/// @throws InputError, StateError as fit_gray
Fit fit_debye_gruneisen(std::span<const md::PointRecord> points, const FitSettings& settings,
                        const std::string& store_name);

/// Returns the Debye temperature of an isotropic solid, K: (hbar/k)(6 pi^2 n)^(1/3) v with v the mean of the sound
/// speeds, 3/v^3 = 2/v_t^3 + 1/v_l^3 (Anderson, J. Phys. Chem. Solids 24 (1963) 909).
/// @param bulk_modulus, shear_modulus  Pa
/// @param volume                       m^3/kg
/// @param molar_mass                   kg/mol of atoms
double debye_temperature(double bulk_modulus, double shear_modulus, double volume, double molar_mass);

}  // namespace whipple::fit

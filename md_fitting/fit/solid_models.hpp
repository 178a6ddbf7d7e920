// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/fit_result.hpp"

/// Fits of the equations of state of a solid without phases, by the same problem as GRAY's
/// (docs/theory/fit.md, section 7).
namespace whipple::fit {

/// rho0, c0, s, Gamma0, b of rho Gamma = rho0 (Gamma0 + b mu), and a constant heat capacity.
/// @throws InputError, StateError as fit_gray
Fit fit_mie_gruneisen(std::span<const md::PointRecord> points, const FitSettings& settings,
                      const std::string& store_name);

/// rho0, K0 and K0' of Vinet's isotherm, gamma0 and a of the linear law, with coexistence T_m0. The Debye
/// temperature, of which classical nuclei know nothing, comes from the elastic constants of the store or from
/// the element's table.
/// @throws InputError, StateError as fit_gray
Fit fit_debye_gruneisen(std::span<const md::PointRecord> points, const FitSettings& settings,
                        const std::string& store_name);

/// Debye temperature of an isotropic solid, K: (hbar/k)(6 pi^2 n)^(1/3) v with v the mean of the speeds of
/// sound, 3/v^3 = 2/v_t^3 + 1/v_l^3 (Anderson, J. Phys. Chem. Solids 24 (1963) 909).
/// @param bulk_modulus, shear_modulus  Pa
/// @param volume                       m^3/kg
/// @param molar_mass                   kg/mol of atoms
double debye_temperature(double bulk_modulus, double shear_modulus, double volume, double molar_mass);

}  // namespace whipple::fit

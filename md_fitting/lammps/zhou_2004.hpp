// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "md_fitting/lammps/eam_tables.hpp"

/// Tabulates the embedded-atom potentials of Zhou, Johnson and Wadley, Phys. Rev. B 69 (2004) 144113, from their
/// published formulas and constants: with r_e the nearest-neighbour distance and rho_e the equilibrium density,
///   phi(r) = A exp[-alpha (r/r_e - 1)]/[1 + (r/r_e - kappa)^20] - B exp[-beta (r/r_e - 1)]/[1 + (r/r_e -
///   lambda)^20], f(r) = f_e exp[-beta (r/r_e - 1)]/[1 + (r/r_e - lambda)^20], F(rho): a cubic below 0.85
///   rho_e, a cubic up to 1.15 rho_e, above it F_e [1 - eta ln(rho/rho_s)] (rho/rho_s)^eta.
/// The formulas are unbounded; the tables extend to 12 rho_e, which the static crystal reaches below V/V0 = 0.25.
namespace whipple::md {

inline constexpr const char* zhou_2004_name = "zhou_2004";

/// Returns the elements with cubic crystals among the sixteen of the publication.
std::vector<std::string> zhou_2004_elements();

/// Returns the tables of an element. @throws InputError for an unknown element, listing those available
EamTables zhou_2004(const std::string& element);

}  // namespace whipple::md

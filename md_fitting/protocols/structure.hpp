// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/statistics.hpp"

namespace whipple::md {

/// Bond-orientational order q6 (Steinhardt, Nelson, Ronchetti, Phys. Rev. B 28 (1983) 784) of the nearest
/// neighbours (12 in fcc, 14 in bcc) above which an atom counts as crystalline: hot fcc has 0.5, its melt 0.35.
inline constexpr double crystal_order = 0.45;

/// Defines the compute `order` and the atom variable `is_crystal`, for the volume that the cell has now.
void define_crystal_order(Lammps& lammps, const Potential& potential);

/// Returns the fraction of crystalline atoms at the current positions, at the cost of one force evaluation. About
/// 0.5 in a crystal near its melting point, below 0.1 in a melt.
double crystal_share(Crystal& crystal, const Potential& potential);

/// Returns the fraction of crystalline atoms after minimisation to the nearest minimum of the energy at constant
/// volume, which removes the disorder of thermal motion. About 1 in a crystal at any temperature, 0.1 to 0.2 in a melt.
double inherent_crystal_share(Crystal& crystal, const Potential& potential);

/// Returns the nearest-neighbour distance in the crystal, m.
double neighbour_distance(const Potential& potential, double specific_volume);

/// Checks that a crystal is at an energy minimum: vibrating about its sites it has more potential energy than the
/// static one at the same volume, or at zero pressure. A crystal with less energy has left its sites for a
/// different structure.
/// @param energy       eV per atom, including the kinetic energy
/// @param cold_energy  of the static crystal
/// @throws StateError naming potential, structure, temperature and both energies
void require_stable(bool solid, const Estimate& energy, double cold_energy, double temperature,
                    const Potential& potential);

/// Threshold between the crystal fractions of melts and of crystals after minimisation.
inline constexpr double solid_share_limit = 0.5;

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/statistics.hpp"

namespace whipple::md {

/// Bond-orientational order q6 (Steinhardt, Nelson, Ronchetti, Phys. Rev. B 28 (1983) 784) of the nearest
/// neighbours (12 in fcc, 14 in bcc) above which an atom counts as crystal: hot fcc has 0.5, its melt 0.35.
inline constexpr double crystal_order = 0.45;

/// Fraction of the atoms of the present positions that count as crystal; one more evaluation of the forces.
/// About 0.5 in a crystal near its melting point, below 0.1 in a melt.
double crystal_share(Crystal& crystal, const Potential& potential);

/// Returns the fraction of crystalline atoms after all have moved to the nearest minimum of the energy at constant
/// volume, without the disorder of thermal motion. About 1 in a crystal of any temperature, 0.1 to 0.2 in a melt.
double inherent_crystal_share(Crystal& crystal, const Potential& potential);

/// Distance of nearest neighbours in the crystal, m.
double neighbour_distance(const Potential& potential, double specific_volume);

/// A crystal that vibrates about its sites has more potential energy than the static one at the same volume,
/// or at zero pressure. One that has less was no minimum: it left its sites for others.
/// @param energy       eV per atom, with the kinetic energy
/// @param cold_energy  of the static crystal
/// @throws StateError naming potential, structure, temperature and both energies
void require_stable(bool solid, const Estimate& energy, double cold_energy, double temperature,
                    const Potential& potential);

/// Between the crystal fractions of melts and crystals after their way to the minimum.
inline constexpr double solid_share_limit = 0.5;

}  // namespace whipple::md

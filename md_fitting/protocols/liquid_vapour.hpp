// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/liquid_vapour.hpp"
#include "md_fitting/protocols/replicas.hpp"

namespace whipple::md {

/// One run of a film.
struct FilmRun : LiquidVapourPoint {
  double vapour_atoms = 0.0;  ///< mean number of atoms in the vapour
};

/// Simulates a film of melt in equilibrium with its vapour, at constant volume and temperature, in independent
/// runs.
/// @throws StateError if film and vapour do not separate in too many runs (too hot), or if the vapour contains too
/// few atoms (too cold).
ReplicaSet<FilmRun> measure_liquid_vapour(const Potential& potential, double temperature,
                                          const LiquidVapourPlan& section, std::int64_t seed);

/// Returns the centre of a group of positions in a period: the mean of their directions on a circle.
/// @returns 0 ... period
double circular_mean(std::span<const double> places, double period);

/// Describes the interface between the two plateaus of a density profile, in the coordinate of the profile.
struct Interface {
  double place = 0.0;  ///< position where the density is half way
  double width = 0.0;  ///< from 90 to 10 %
};
/// Finds the interface in a density profile.
/// @param profile density over the distance from the centre of the film, in equal steps
/// @throws StateError if the profile does not have two plateaus.
Interface find_interface(std::span<const double> profile, double step);

}  // namespace whipple::md

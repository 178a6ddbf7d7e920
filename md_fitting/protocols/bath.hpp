// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "md_fitting/lammps/lammps.hpp"

namespace whipple::md {

/// Couples all atoms to a Langevin bath whose random forces add up to zero, so that the centre of mass stays
/// at rest; beside it an integrator at constant energy or enthalpy moves the atoms. Unlike a Nose-Hoover
/// chain it makes every vibration forget its energy within a known time.
/// @param temperature K
/// @param time_step   ps
void couple_to_bath(Lammps& lammps, double temperature, double time_step, std::int64_t seed);

/// Samples of a thermal quantity of a crystal in the bath, freed of what only adds noise to their mean
/// (docs/theory/molecular_dynamics.md, equation 4a). The kinetic temperature T_i is a control variate, whose
/// expectation the bath sets (Lavenberg & Welch, Management Sci. 27 (1981) 322): from sample x_i is taken
/// (<x> - x_cold) (T_i - T)/T, what the wandering temperature adds to a quantity whose thermal part is
/// proportional to it. Whatever that factor, the mean stays the right one. Averages over windows of one or
/// two vibrations then leave what wanders slowly, from which the error comes.
/// @param cold         value of the quantity in the static crystal
/// @param temperatures kinetic temperature (K), sampled together with the series
/// @param temperature  of the bath, K
/// @param interval     steps between samples
std::vector<double> in_bath(std::span<const double> samples, double cold,
                            std::span<const double> temperatures, double temperature, std::int64_t interval);

}  // namespace whipple::md

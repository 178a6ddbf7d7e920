// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "md_fitting/lammps/lammps.hpp"

namespace whipple::md {

/// Couples all atoms to a Langevin bath whose random forces add up to zero, so that the centre of mass stays at
/// rest; an integrator at constant energy or enthalpy moves the atoms. Unlike a Nose-Hoover chain, the bath
/// decorrelates the energy of every vibration within a known time.
/// @param temperature K
/// @param time_step   ps
void couple_to_bath(Lammps& lammps, double temperature, double time_step, std::int64_t seed);

/// Returns samples of a thermal quantity of a crystal in the bath, with noise removed that does not affect their
/// mean (docs/theory/molecular_dynamics.md, equation 4a). The kinetic temperature T_i is a control variate, whose
/// expectation is set by the bath (Lavenberg & Welch, Management Sci. 27 (1981) 322): (<x> - x_cold) (T_i - T)/T,
/// the effect of the temperature fluctuation on a quantity whose thermal part is proportional to it, is subtracted
/// from sample x_i. The mean is unbiased for any such factor. Averages over windows of one or two vibrations then
/// retain the slow fluctuations, which determine the error.
/// @param cold         value of the quantity in the static crystal
/// @param temperatures kinetic temperature (K), sampled together with the series
/// @param temperature  of the bath, K
/// @param interval     steps between samples
std::vector<double> in_bath(std::span<const double> samples, double cold,
                            std::span<const double> temperatures, double temperature, std::int64_t interval);

}  // namespace whipple::md

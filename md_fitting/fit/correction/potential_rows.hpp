// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "md_fitting/fit/correction/correction_data.hpp"
#include "md_fitting/fit/joint/potential_errors.hpp"

namespace whipple::fit {

/// Adds to simulated data how the potential deviates from the metal, for a correction that follows measurements too: cold
/// pressure and energy of every volume are free, thermal pressures, anharmonic heats, melting temperatures and heats of
/// fusion deviate smoothly by sizes that are estimated (docs/theory/fit.md, sections 9 and 10).
void add_potential_errors(CorrectionData& data, const eos::GrayFreeEnergy& simulated,
                          const PotentialErrors& errors = {});

/// Moves simulated data to the metal, whose corrections are the same functions of V/V0.
/// @param ratio  V0 of the metal over that of the simulation
void move_to(CorrectionData& data, double ratio);

}  // namespace whipple::fit

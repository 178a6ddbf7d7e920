// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/simulation.hpp"

namespace whipple::run {

/// What a run will cost, as ranges. Runs of all cases of the repository lie inside those of the steps.
struct Forecast {
  double least_steps = 0.0, most_steps = 0.0;
  double nanoseconds = 0.0;     ///< per particle or element and step, measured with all of them taking part
  double moving_share = 1.0;    ///< of the particles and elements, mean over the run; others rest
  double least_time = 0.0, most_time = 0.0;  ///< s of wall time
};

/// Predicts steps and wall time of a case from a few steps with all matter taking part.
///
/// Steps: the end of the run over the time step that the state allows at the start, `time.first_step` left
/// aside; where hot matter raises the speed of sound the step is shorter, where what was fast has been stopped
/// it is longer. Time: matter at rest costs next to nothing; a particle takes part from when the sound, or the
/// fastest matter, can have come to it from the bodies that move.
/// @param simulation  at its start, with `transfer.rest_tolerance` 0, so that all matter takes part; advanced
Forecast forecast(solver::Simulation& simulation);

}  // namespace whipple::run

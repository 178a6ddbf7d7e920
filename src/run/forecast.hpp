// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/simulation.hpp"

namespace whipple::run {

/// Holds the expected cost of a run as ranges. The ranges of the number of steps include all cases of the repository.
struct Forecast {
  double least_steps = 0.0, most_steps = 0.0;
  double nanoseconds = 0.0;   ///< per particle or element and step, measured with no block inactive
  double moving_share = 1.0;  ///< mean active fraction of the particles and elements over the run
  double least_time = 0.0, most_time = 0.0;  ///< s of wall time
};

/// Holds the bounds on the particles added by splitting.
struct SplittingForecast {
  double generations = 0.0;       ///< maximum number of successive divisions of a particle; 0: no splitting
  bool fluid_from_start = false;  ///< otherwise only material that melts or boils is divided
  double most_particles =
      0.0;  ///< on all ranks, if all material that may become fluid were divided as often as possible
};
/// Bounds the number of particles of a case in its initial state. Collective.
SplittingForecast forecast_splitting(const solver::Simulation& simulation);

/// Predicts steps and wall time of a case from a few measured steps. Collective.
///
/// Steps: the end time divided by the time step that the initial state allows. Smaller steps are added for the growth
/// from `time.first_step`, at the beginning and after each possible first contact of bodies, and at the times of
/// snapshots. Hot material with a higher sound speed shortens the step, decelerated material lengthens it. Time:
/// inactive blocks cost almost nothing; a particle becomes active as soon as a sound wave or the fastest material can
/// have reached it from the moving bodies.
/// @param simulation  in its initial state, with `transfer.rest_tolerance` 0 so that no block is inactive; advanced
Forecast forecast(solver::Simulation& simulation);

}  // namespace whipple::run

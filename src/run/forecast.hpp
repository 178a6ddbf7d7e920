// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/simulation.hpp"

namespace whipple::run {

/// Holds the expected cost of a run as ranges. All cases of the repository lie within those of the steps.
struct Forecast {
  double least_steps = 0.0, most_steps = 0.0;
  double nanoseconds = 0.0;   ///< per particle or element and step, measured with no block inactive
  double moving_share = 1.0;  ///< mean active fraction of the particles and elements over the run
  double least_time = 0.0, most_time = 0.0;  ///< s of wall time
};

/// Holds what particle splitting may add.
struct SplittingForecast {
  double generations = 0.0;     ///< successive divisions of a particle, at most; 0: nothing is divided
  bool fluid_from_start = false;  ///< else only what melts or boils is divided
  double most_particles = 0.0;  ///< of all ranks, if all that may become fluid were divided as often as it may
};
/// Bounds the number of particles of a case in its initial state. Collective.
SplittingForecast forecast_splitting(const solver::Simulation& simulation);

/// Predicts steps and wall time of a case from a few measured steps. Collective.
///
/// Steps: the end time over the time step that the initial state allows, after steps that grow from `time.first_step`, at
/// the beginning and again where bodies may touch for the first time, and ends at the times of snapshots; hot material
/// with a higher sound speed shortens the step, decelerated material lengthens it. Time: inactive blocks cost
/// next to nothing; a particle becomes active once sound, or the fastest material, can have reached it from the
/// moving bodies.
/// @param simulation  in its initial state, with `transfer.rest_tolerance` 0 so that no block is inactive; advanced
Forecast forecast(solver::Simulation& simulation);

}  // namespace whipple::run

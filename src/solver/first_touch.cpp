// SPDX-License-Identifier: BSD-3-Clause
// The time step where bodies touch for the first time (docs/theory/mpm.md, section 6).
#include <algorithm>

#include "src/solver/simulation.hpp"

namespace whipple::solver {
namespace {

/// A step that is longer than the first by no more than this counts as small.
constexpr double tolerance = 1.01;

}  // namespace

double Simulation::stable_time_step() {
  accurate_step_ = accurate_time_step();
  // The first step does not know yet how hard bodies that touch will meet.
  if (state_.time_step == 0.0) return setup_.time.first_step * accurate_step_;
  return landing_on_touch(std::min(accurate_step_, setup_.time.maximum_growth * state_.unclipped_step));
}

/// The step ends when they touch, and the next is as small as the first of a run.
double Simulation::landing_on_touch(double dt) const {
  const double left = state_.first_touch - state_.time;
  return left < dt ? std::min(dt, std::max(left, setup_.time.first_step * accurate_step_)) : dt;
}

/// Watches touches that could strain material, in one whole step, by more than the time step is to
/// follow.
void Simulation::watch_touches() {
  const double strain = setup_.time.compression_limit;
  first_touches_->begin_step(state_.time_step, strain * setup_.domain.cell_size / accurate_step_);
}

void Simulation::foresee_touches() {
  if (!contact_ && !may_meet_images()) return;
  const transfer::FirstTouches::Outcome seen = first_touches_->end_step(communicator_);
  state_.touched = first_touches_->words();
  const double begin = state_.time - state_.time_step;
  const bool too_long = state_.time_step > tolerance * setup_.time.first_step * accurate_step_;
  state_.first_touch = seen.hard && too_long ? state_.time : seen.next < 1e300 ? begin + seen.next : 1e300;
}

}  // namespace whipple::solver

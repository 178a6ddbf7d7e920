// SPDX-License-Identifier: BSD-3-Clause
// First contact of bodies (docs/theory/mpm.md, section 6).
#include <algorithm>

#include "src/solver/stages/contact.hpp"

namespace whipple::solver {
namespace {

/// Maximum ratio to the initial time step at which a step counts as small.
constexpr double small_step_ratio = 1.01;

}  // namespace

void ContactStage::watch_touches(double accurate_step) {
  first_touches_->begin_step(state_.run.time_step, least_closing_speed(accurate_step));
}

double ContactStage::least_closing_speed(double accurate_step) const {
  const double strain = state_.setup.time.compression_limit;
  return strain * state_.setup.domain.cell_size / accurate_step;
}

void ContactStage::foresee_touches(double accurate_step) {
  if (!contact_ && !may_meet_images()) return;
  const contact::FirstTouches::Outcome seen = first_touches_->end_step(state_.communicator);
  state_.run.touched = first_touches_->words();
  const double begin = state_.run.time - state_.run.time_step;
  const bool too_long =
      state_.run.time_step > small_step_ratio * state_.setup.time.first_step * accurate_step;
  state_.run.first_touch = seen.hard && too_long ? state_.run.time
                           : seen.next < 1e300   ? begin + seen.next
                                                 : 1e300;
}

}  // namespace whipple::solver

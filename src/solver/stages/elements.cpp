// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/elements.hpp"

#include <string>

#include "src/core/parallel/mpi.hpp"
#include "src/solver/stages/time_step.hpp"

namespace whipple::solver {
namespace {

constexpr std::int64_t conversion_every = 4;  // steps, each of which adds a few per cent of distortion

}  // namespace

/// Lists the nodes that move with the grid in this step.
void ElementStage::collect() {
  state_.transition.resize(0);
  state_.transition.unrelaxed = 0;
  state_.transition_body.clear();
  state_.transition_part.clear();
  for (Carrier* carrier : carriers_) carrier->collect();
}

void ElementStage::adapt(bool contact) {
  if (are_none()) return;
  partition_.share_out_elements();
  if (hexahedra_.empty()) return collect();
  if (state_.run.step % conversion_every == 0) {
    state_.profile.time("convert elements", [&] {
      collect();  // of the previous step: these limit the time step of the grid
      hexahedra_.convert(particles_, grid_time_step(state_, particles_));
    });
  }
  state_.profile.time("transition", [&] {
    hexahedra_.mark_transition();
    collect();
    if (state_.run.step == 0 && !contact) hexahedra_.warn_of_contact();
  });
}

void ElementStage::compute_forces() {
  if (are_none()) return;
  state_.profile.time("element forces", [&] {
    for (Carrier* carrier : carriers_) carrier->compute_forces();
    collect();
    for (Carrier* carrier : carriers_) carrier->join_shared_nodes();
  });
}

void ElementStage::advance() {
  if (are_none()) return;
  state_.profile.time("elements", [&] {
    std::string error;
    for (Carrier* carrier : carriers_) {
      const std::string of_carrier = carrier->advance();
      if (error.empty()) error = of_carrier;
    }
    parallel::throw_together(state_.communicator, error);
  });
}

}  // namespace whipple::solver

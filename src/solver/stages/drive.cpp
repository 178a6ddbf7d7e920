// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/drive.hpp"

#include "src/core/parallel/mpi.hpp"

namespace whipple::solver {

Drive::Drive(const cases::Case& setup) {
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const cases::Body& body = setup.bodies[b];
    if (!body.driven) continue;
    driven_.push_back(
        {.body = b, .velocity = body.velocity, .guided = body.guided_axes(setup), .path = body.path});
  }
}

void Drive::add(State& state, std::vector<Vector3>& acceleration) const {
  if (driven_.empty()) return;
  const Particles& particles = state.particles;
  std::vector<double> sums(4 * driven_.size(), 0.0);  // mass and momentum of each body
  for (std::size_t d = 0; d < driven_.size(); ++d) {
    const cases::BodySummary& own = state.bodies[driven_[d].body];
    for (std::size_t p = own.first; p < own.first + own.count; ++p) {
      sums[4 * d] += particles.mass[p];
      for (int i = 0; i < 3; ++i) sums[4 * d + 1 + i] += particles.mass[p] * particles.velocity[p][i];
    }
  }
  parallel::sum(state.communicator, sums);
  for (std::size_t d = 0; d < driven_.size(); ++d) {
    if (!(sums[4 * d] > 0.0)) continue;  // all of it has left
    const Driven& driven = driven_[d];
    DrivenBody& last = state.run.driven[driven.body];
    const Vector3 velocity = Vector3(sums[4 * d + 1], sums[4 * d + 2], sums[4 * d + 3]) / sums[4 * d];
    const double dt = state.run.time_step;
    const double factor = driven.path ? driven.path->factor(state.run.time, dt) : 1.0;
    Vector3 added = (factor * driven.velocity - velocity) / dt;
    if (last.time_step > 0.0) added -= (velocity - last.velocity) / last.time_step - last.acceleration;
    for (int axis = 0; axis < 3; ++axis) {
      if (driven.guided[axis]) added[axis] = 0.0;
    }
    last = {.velocity = velocity, .acceleration = added, .time_step = dt};
    const cases::BodySummary& own = state.bodies[driven.body];
    for (std::size_t p = own.first; p < own.first + own.count; ++p) acceleration[p] += added;
  }
}

}  // namespace whipple::solver

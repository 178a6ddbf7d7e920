// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/drive.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "src/core/parallel/mpi.hpp"

namespace whipple::solver {
namespace {

/// Centre of mass of a body over all ranks, its velocity, and its spin about the axes that are held.
struct RigidMotion {
  double mass = 0.0;
  Vector3 centre = Vector3::Zero(), velocity = Vector3::Zero(), spin = Vector3::Zero();
};

/// Particles of a body on this rank.
struct Members {
  const Particles& particles;
  std::size_t first, end;
};

/// Sums over the particles of a body: mass, momentum, first moment of the mass. Collective.
RigidMotion centre_of(MPI_Comm communicator, const Members& members) {
  const Particles& q = members.particles;
  std::array<double, 7> sums{};
  Eigen::Map<Vector3> momentum(sums.data() + 1), moment(sums.data() + 4);
  for (std::size_t p = members.first; p < members.end; ++p) {
    sums[0] += q.mass[p];
    momentum += q.mass[p] * q.velocity[p];
    moment += q.mass[p] * q.position[p];
  }
  parallel::sum(communicator, sums);
  RigidMotion motion{.mass = sums[0]};
  if (!(motion.mass > 0.0)) return motion;
  motion.velocity = momentum / motion.mass;
  motion.centre = moment / motion.mass;
  return motion;
}

/// Computes the spin of a body about its centre: I w = H, about single axes where others are guided. Collective.
/// @param held  axes about which the body may turn and is held
Vector3 spin_of(MPI_Comm communicator, const Members& members, const RigidMotion& motion,
                const std::array<bool, 3>& held) {
  const Particles& q = members.particles;
  std::array<double, 12> sums{};
  Eigen::Map<Vector3> angular_momentum(sums.data());
  Eigen::Map<Matrix3> inertia(sums.data() + 3);
  for (std::size_t p = members.first; p < members.end; ++p) {
    const Vector3 r = q.position[p] - motion.centre;
    angular_momentum += q.mass[p] * r.cross(q.velocity[p] - motion.velocity);
    inertia += q.mass[p] * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
  }
  parallel::sum(communicator, sums);
  const double least = 1e-9 * inertia.trace();  // of a rod about its axis: round-off
  for (int axis = 0; axis < 3; ++axis) {
    if (held[static_cast<std::size_t>(axis)] && inertia(axis, axis) > least) continue;
    angular_momentum[axis] = 0.0;
    inertia.row(axis).setZero();
    inertia.col(axis).setZero();
    inertia(axis, axis) = 1.0;
  }
  return inertia.ldlt().solve(angular_momentum);
}

}  // namespace

Drive::Drive(const cases::Case& setup) {
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const cases::Body& body = setup.bodies[b];
    if (!body.driven) continue;
    const std::array<bool, 3> guided = body.guided_axes(setup);
    // A mirror plane keeps a body from turning about the axes in it.
    const std::array<bool, 3> turns = {!guided[1] && !guided[2], !guided[2] && !guided[0],
                                       !guided[0] && !guided[1]};
    driven_.push_back(
        {.body = b, .velocity = body.velocity, .guided = guided, .turns = turns, .path = body.path});
  }
}

void Drive::add(State& state, std::vector<Vector3>& acceleration) const {
  const double dt = state.run.time_step;
  for (const Driven& driven : driven_) {
    const cases::BodySummary& own = state.bodies[driven.body];
    const Members members{state.particles, own.first, own.first + own.count};
    RigidMotion motion = centre_of(state.communicator, members);
    if (!(motion.mass > 0.0)) continue;  // all of it has left
    const bool turns = std::ranges::any_of(driven.turns, [](bool about) { return about; });
    if (turns) motion.spin = spin_of(state.communicator, members, motion, driven.turns);
    DrivenBody& last = state.run.driven[driven.body];
    const double factor = driven.path ? driven.path->factor(state.run.time, dt) : 1.0;
    Vector3 added = (factor * driven.velocity - motion.velocity) / dt, turning = -motion.spin / dt;
    if (last.time_step > 0.0) {
      added -= (motion.velocity - last.velocity) / last.time_step - last.acceleration;
      turning -= (motion.spin - last.spin) / last.time_step - last.spin_acceleration;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (driven.guided[static_cast<std::size_t>(axis)]) added[axis] = 0.0;
      if (!driven.turns[static_cast<std::size_t>(axis)]) turning[axis] = 0.0;
    }
    last = {.velocity = motion.velocity,
            .acceleration = added,
            .spin = motion.spin,
            .spin_acceleration = turning,
            .time_step = dt};
    for (std::size_t p = members.first; p < members.end; ++p) {
      acceleration[p] += added;
      if (turns) acceleration[p] += turning.cross(state.particles.position[p] - motion.centre);
    }
  }
}

}  // namespace whipple::solver

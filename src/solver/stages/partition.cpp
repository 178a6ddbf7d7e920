// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/partition.hpp"

#include <span>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/particles/migrate.hpp"
#include "src/solver/work.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple::solver {
namespace {

constexpr std::int64_t sort_every = 20;  // steps between sorts of the particle arrays
constexpr double lookahead_steps = 8.0;  // motion covered by the active blocks

/// Returns points and additional points in one span; `all` stores the combined list if there are additional points.
std::span<const Vector3> with(std::span<const Vector3> points, std::span<const Vector3> more,
                              std::vector<Vector3>& all) {
  if (more.empty()) return points;
  all.assign(points.begin(), points.end());
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

void Partition::bin_particles() {
  if (!bin() || activity_.has_much_woken()) follow_particles();
  if (state_.run.step % sort_every != 0) return;
  state_.grid.wake();
  particles_.sort();
  if (!bin()) follow_particles();
}

/// Bins the particles, and nodes of elements as off-grid points.
bool Partition::bin() {
  return state_.grid.bin(state_.particles.position, transfer::stencil(state_.shape),
                         state_.transition.position);
}

void Partition::share_out_elements() {
  if (!std::exchange(elements_astray_, false)) return;
  for (Carrier* carrier : carriers_) carrier->share_out();
}

/// Adapts the blocks to the present and predicted positions of particles and off-grid points, and sends particles to
/// the rank that owns their block.
void Partition::follow_particles() {
  const double lookahead = lookahead_steps * state_.run.time_step;
  const Particles& particles = state_.particles;
  std::vector<Vector3> all_positions, all_velocities;
  const auto positions = [&] { return with(particles.position, state_.transition.position, all_positions); };
  const auto velocities = [&] {
    return with(particles.velocity, state_.transition.velocity, all_velocities);
  };
  adapt(positions(), velocities(), lookahead);
  if (state_.is_parallel() &&
      migrate(state_.particles, state_.grid.owners(particles.position), state_.communicator)) {
    state_.find_bodies();
  }
  state_.grid.activate(positions(), velocities(), lookahead, transfer::stencil(state_.shape),
                       state_.transition.size());
  if (!bin()) throw InternalError("adaptation left a particle without its blocks");
}

/// Adapts the forest of blocks and distributes it over the ranks by their work.
void Partition::adapt(std::span<const Vector3> positions, std::span<const Vector3> velocities,
                      double lookahead) {
  const grid::Stencil stencil = transfer::stencil(state_.shape);
  elements_astray_ = state_.is_parallel();
  if (!state_.is_parallel()) {  // with one rank there is no distribution
    state_.grid.adapt(positions, velocities, lookahead, stencil, {work_, work_of_block});
    return;
  }
  work_of_particles(state_.setup, state_.bodies, work_);
  if (activity_.material_may_rest()) {
    parallel::for_each(work_.size(),
                       [&](std::size_t p) { work_[p] *= activity_.is_restless(p) ? 1.0 : share_of_rest; });
    activity_.blocks_shared_out();
  }
  if (!std::ranges::any_of(carriers_, [](const Carrier* carrier) { return carrier->weighs(); })) {
    state_.grid.adapt(positions, velocities, lookahead, stencil, {work_, work_of_block});
    return;
  }
  std::vector<Vector3> centres, all_positions, all_velocities;
  work_.resize(positions.size(), 1.0);  // nodes of elements
  for (const Carrier* carrier : carriers_) carrier->add_work(centres, work_);
  const std::span<const Vector3> at = with(positions, centres, all_positions);
  const std::vector<Vector3> at_rest(centres.size(), Vector3::Zero());
  state_.grid.adapt(at, with(velocities, at_rest, all_velocities), lookahead, stencil,
                    {work_, work_of_block, centres.size()});
}

}  // namespace whipple::solver

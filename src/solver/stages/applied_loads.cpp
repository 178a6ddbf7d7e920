// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/applied_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::solver {

AppliedLoads::AppliedLoads(State& state, const Carriers& carriers) : state_(state), carriers_(carriers) {
  const auto add = [&](const cases::AppliedLoad& load) {
    applied_.push_back(
        {.of = load, .region = load.region(state.setup), .force = load.total_force(state.setup)});
  };
  for (const cases::AppliedLoad& load : state.setup.loads) add(load);
  const cases::Gravity& gravity = state.setup.gravity;
  if (gravity.acceleration.isZero(0.0)) return;
  cases::AppliedLoad of_all;
  of_all.acceleration = gravity.acceleration;
  of_all.table = gravity.factor();
  add(of_all);
  applied_.back().everywhere = true;
}

void AppliedLoads::add_to(Loads& loads) const {
  for (const Applied& load : applied_) {
    std::function<Vector3(double)> of_all;
    if (load.everywhere) of_all = [&load](double) { return load.acceleration; };
    loads.add({.name = "load",
               .add =
                   [&load](const LoadedPoints& points, double, std::span<Vector3> sum) {
                     for (std::size_t p = 0; p < sum.size(); ++p) {
                       if (!load.region.contains(points.body, points.position[p])) continue;
                       sum[p] += load.acceleration - load.damping * points.velocity[p];
                     }
                   },
               .next_event =
                   [&load, this](double time) {
                     // A step that contains the beginning receives the part of the factor in it.
                     const double next = load.of.table.next_event(time);
                     return next < time + state_.run.time_step ? time : next;
                   },
               .moves = load.of.is_damping() ? Moves::moving_material : Moves::all_material,
               .of_all = of_all});
  }
}

/// Returns the mass (kg) in the regions of the forces over all ranks, 0 for other loads. Collective.
std::vector<double> AppliedLoads::masses() const {
  std::vector<double> mass(state_.setup.loads.size(), 0.0);
  for (std::size_t i = 0; i < mass.size(); ++i) {
    if (!applied_[i].of.is_force()) continue;
    for (const Carrier* carrier : carriers_) mass[i] += carrier->mass_in(applied_[i].region);
  }
  parallel::sum(state_.communicator, mass);
  return mass;
}

void AppliedLoads::weigh() {
  state_.run.loaded_mass = masses();
  for (std::size_t i = 0; i < state_.run.loaded_mass.size(); ++i) {
    if (!applied_[i].of.is_force() || state_.run.loaded_mass[i] > 0.0) continue;
    throw InputError(fmt::format(
        "{}: [[load]] {}: no particle or node is in its region at the start: nothing could take its force",
        state_.setup.file.string(), i + 1));
  }
}

void AppliedLoads::begin() {
  const double time = state_.run.time, dt = state_.run.time_step;
  set([=](const cases::TimeTable& table) { return table.mean(time, dt); }, dt);
}

void AppliedLoads::hold(double time) {
  set([=](const cases::TimeTable& table) { return table.at(time); }, state_.run.time_step);
}

/// Computes the accelerations of a step of the length dt (s).
/// @param factor_of  factor_of(table): in this step
template <class Factor>
void AppliedLoads::set(const Factor& factor_of, double dt) {
  bool pushes = false;
  for (Applied& load : applied_) {
    const double factor = factor_of(load.of.table);
    load.acceleration = factor * load.of.acceleration;
    // The exact decay over the step: no step is too long for it.
    load.damping = load.of.is_damping() ? -std::expm1(-factor * load.of.damping * dt) / dt : 0.0;
    pushes = pushes || (load.of.is_force() && factor != 0.0);
  }
  if (!pushes) return;
  const std::vector<double> now = masses();
  for (std::size_t i = 0; i < now.size(); ++i) {
    Applied& load = applied_[i];
    if (!load.of.is_force()) continue;
    // What leaves the region takes its part of the force away; what enters it shares the force.
    load.acceleration = factor_of(load.of.table) / std::max(now[i], state_.run.loaded_mass[i]) * load.force;
  }
}

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/applied_loads.hpp"

#include <cmath>

#include "src/core/parallel/mpi.hpp"

namespace whipple::solver {

AppliedLoads::AppliedLoads(const State& state, const Carriers& carriers)
    : state_(state), carriers_(carriers) {
  for (const cases::AppliedLoad& load : state.setup.loads) {
    applied_.push_back(
        {.of = &load, .region = load.region(state.setup), .force = load.total_force(state.setup)});
  }
}

void AppliedLoads::add_to(Loads& loads) const {
  for (const Applied& load : applied_) {
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
                     const double next = load.of->table.next_event(time);
                     return next < time + state_.run.time_step ? time : next;
                   }});
  }
}

/// Sums the mass in the regions of the forces over all ranks.
void AppliedLoads::weigh(std::vector<double>& mass) const {
  for (const Carrier* carrier : carriers_) {
    carrier->for_each_point([&](const Point& point) {
      for (std::size_t i = 0; i < applied_.size(); ++i) {
        if (applied_[i].of->is_force() && applied_[i].region.contains(point.body, point.position)) {
          mass[i] += point.mass;
        }
      }
    });
  }
  parallel::sum(state_.communicator, mass);
}

void AppliedLoads::begin() {
  if (applied_.empty()) return;
  const double time = state_.run.time, dt = state_.run.time_step;
  std::vector<double> mass(applied_.size(), 0.0);
  weigh(mass);
  for (std::size_t i = 0; i < applied_.size(); ++i) {
    Applied& load = applied_[i];
    const cases::AppliedLoad& of = *load.of;
    const double factor = of.table.mean(time, dt);
    load.acceleration = factor * of.acceleration;
    // Material may have left the region.
    if (of.is_force())
      load.acceleration = mass[i] > 0.0 ? Vector3(factor / mass[i] * load.force) : Vector3::Zero();
    // The exact decay over the step: no step is too long for it.
    load.damping =
        of.damping == cases::AppliedLoad::not_given ? 0.0 : -std::expm1(-factor * of.damping * dt) / dt;
  }
}

}  // namespace whipple::solver

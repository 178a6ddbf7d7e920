// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::solver {
namespace {

// Relative to the available energy: not reached by a scheme with exact energy, exceeded by a fault at once.
constexpr double tolerance = 0.02;
constexpr double round_off = 1e-6;
constexpr double round_off_of_speed = 1e-9;
// Of a cell per step, which no wave exceeds: a motion that round-off of the stresses may cause in material at rest.
constexpr double round_off_of_motion = 1e-12;

double moving(const Totals& t) {
  return t.kinetic_energy + t.affine_kinetic_energy + t.unresolved_energy + t.hourglass_energy;
}

}  // namespace

Plausibility::Plausibility(State& state, const Carriers& carriers)
    : state_(state),
      carriers_(carriers),
      has_walls_(std::ranges::any_of(state.setup.geometry.boundary,
                                     [](grid::Boundary face) { return face != grid::Boundary::outflow; })) {
  for (const cases::AppliedLoad& load : state.setup.loads) {
    const Vector3& of_factor_1 = load.is_force() ? load.total_force(state.setup) : load.acceleration;
    load_.push_back(of_factor_1.norm());
  }
}

/// Returns the speed (m/s) that no material exceeds by loads alone: those of the case act on parts of it.
double Plausibility::speed_by_loads() const {
  double speed = 0.0;
  for (std::size_t i = 0; i < load_.size(); ++i) {
    const double mass = state_.run.loaded_mass[i];
    speed +=
        (mass > 0.0 ? load_[i] / mass : load_[i]) * state_.setup.loads[i].table.magnitude(state_.run.time);
  }
  return speed;
}

void Plausibility::begin() {
  const Vector3 of_frame = frame();
  Releasable releasable;
  double fastest = 0.0;
  for (Carrier* carrier : carriers_) {
    carrier->add_releasable(releasable);
    fastest = std::max(fastest, carrier->largest_speed(of_frame));
  }
  for (const cases::Body& body : state_.setup.bodies) {
    if (body.driven && body.path) {
      fastest = std::max(fastest, (body.path->largest() * body.velocity - of_frame).norm());
    }
    for (const cases::NodeCondition& condition : body.node_conditions) {
      const double factor = body.path ? body.path->largest() : 1.0;
      fastest = std::max(fastest, (factor * condition.velocity - of_frame).norm());
    }
  }
  std::array<double, 1> sum = {releasable.energy};
  std::array<double, 2> largest = {fastest, releasable.largest};
  parallel::sum(state_.communicator, sum);
  parallel::maximum(state_.communicator, largest);
  state_.run.releasable_energy = sum[0];
  state_.run.reference_speed = largest[0] + std::sqrt(2.0 * largest[1]);
}

void Plausibility::require() const {
  require_parts();
  require_speeds();
}

void Plausibility::require_parts() const {
  const double error = state_.setup.output.energy_error_limit(state_.setup.time.scheme);
  const Ledger& ledger = state_.run.ledger;
  // Without exact energy, or with a state of unknown origin, there is no check.
  if (!std::isfinite(error) || !(ledger.initial.mass > 0.0)) return;
  const double supply =
      moving(ledger.initial) + std::abs(ledger.external_work) + state_.run.releasable_energy;
  const auto fail = [&](const char* what, double value, const std::string& bound) {
    throw StateError(fmt::format(
        "step {}, t = {} s: the {} is {:.6g} J, {}: the parts of the energy are impossible, "
        "although its sum is exact to {:.1e}",
        state_.run.step, state_.run.time, what, value, bound, ledger.energy_error(state_.totals)));
  };
  const double now = moving(state_.totals) + moving(ledger.outflow);
  const double slow = round_off_of_motion * state_.setup.geometry.cell_size / state_.run.time_step;
  if (now > supply * (1.0 + tolerance + error) + ledger.initial.mass * slow * slow) {
    fail("energy of motion", now,
         fmt::format("more than the {:.6g} J of the start, of external work and of what the materials can "
                     "set free",
                     supply));
  }
  const double scale = std::max(supply, ledger.largest_kinetic_energy);
  if (state_.totals.hourglass_energy < -round_off * scale) {
    fail("hourglass energy", state_.totals.hourglass_energy, "less than 0");
  }
  if (state_.totals.unresolved_energy < -round_off * scale) {
    fail("unresolved energy", state_.totals.unresolved_energy, "less than 0");
  }
}

/// Returns the reference velocity (m/s) of speeds: that of the walls, otherwise that of the centre of mass at the
/// start.
Vector3 Plausibility::frame() const {
  const Totals& initial = state_.run.ledger.initial;
  if (has_walls_ || !(initial.mass > 0.0)) return Vector3::Zero();
  return initial.momentum / initial.mass;
}

void Plausibility::require_speeds() const {
  const Ledger& ledger = state_.run.ledger;
  const double mass = state_.totals.mass + ledger.outflow.mass;
  const double external = mass > 0.0 ? ledger.external_impulse.norm() / mass +
                                           std::sqrt(2.0 * std::abs(ledger.external_work) / mass)
                                     : 0.0;
  const Vector3 of_frame = frame();
  const double limit =
      state_.setup.output.maximum_speed_factor *
      (state_.run.reference_speed + external + speed_by_loads() + round_off_of_speed * of_frame.norm());
  if (!std::isfinite(limit) || !(limit > 0.0)) return;
  double fastest = 0.0;
  for (Carrier* carrier : carriers_) fastest = std::max(fastest, carrier->largest_speed(of_frame));
  const double of_all = parallel::maximum(state_.communicator, fastest);
  if (of_all <= limit) return;
  std::string error;
  if (fastest == of_all) {
    std::string who;
    double most = -1.0;
    for (const Carrier* carrier : carriers_) {
      carrier->for_each_point([&](const Point& point) {
        const double speed = (point.velocity - of_frame).norm();
        if (!(speed > most)) return;
        most = speed;
        who = fmt::format(", of body \"{}\" at ({:.6g}, {:.6g}, {:.6g}) m",
                          state_.setup.bodies[point.body].name, point.position[0], point.position[1],
                          point.position[2]);
      });
    }
    error = fmt::format(
        "step {}, t = {} s: a speed of {:.6g} m/s{} is impossible: more than {} times what the bodies bring "
        "along and can set free (output.maximum_speed_factor)",
        state_.run.step, state_.run.time, of_all, who, state_.setup.output.maximum_speed_factor);
  }
  parallel::throw_together(state_.communicator, error);
}

}  // namespace whipple::solver

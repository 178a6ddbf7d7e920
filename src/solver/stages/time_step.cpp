// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::solver {
namespace {

/// Minimum fraction of the stable time step to which the compression limit may reduce the step, so that a few particles
/// of thin material do not govern it.
constexpr double least_share_for_accuracy = 0.125;

/// Minimum fraction of the longest step so far; a shorter step means that the run would never end.
constexpr double least_share_of_longest = 1e-9;

}  // namespace

double grid_time_step(const State& state, ParticleCarrier& particles) {
  const transfer::TransitionNodes& nodes = state.transition;
  double speed = particles.fastest();
  speed = std::max(speed, parallel::maximum(nodes.size(), 0.0, [&](std::size_t i) {
                     return nodes.sound_speed[i] + nodes.velocity[i].cwiseAbs().maxCoeff();
                   }));
  speed = parallel::maximum(state.communicator, speed);
  return state.setup.time.courant * state.setup.domain.cell_size / speed;
}

void TimeStep::limit(double bound, TimeStepBound by) {
  if (!(bound < step_)) return;
  step_ = bound;
  by_ = by;
}

double TimeStep::accurate() {
  const cases::TimeControl& control = state_.setup.time;
  step_ = grid_time_step(state_, particles_);  // NaN is kept and reported
  cell_step_ = step_ / control.courant;
  by_ = TimeStepBound::sound_speed;
  limit(diffusive_bound(), TimeStepBound::diffusion);
  limit(element_bound(), TimeStepBound::elements);
  if (state_.run.maximum_acceleration > 0.0) {
    limit(std::sqrt(control.acceleration_limit * state_.setup.domain.cell_size /
                    state_.run.maximum_acceleration),
          TimeStepBound::acceleration);
  }
  compression_is_followed_ = true;
  if (state_.run.compression_rate > 0.0) {
    const double accurate = control.compression_limit / state_.run.compression_rate;
    compression_is_followed_ = accurate >= least_share_for_accuracy * step_;
    limit(std::max(accurate, least_share_for_accuracy * step_), TimeStepBound::compression);
  }
  return step_;
}

void TimeStep::begin(double until) {
  state_.profile.time("time step", [&] {
    if (state_.particle_count == 0 && state_.element_count == 0) {
      throw StateError("all material has left the domain");
    }
    const cases::TimeControl& control = state_.setup.time;
    accurate_step_ = accurate();
    const double first_step = control.first_step * accurate_step_;
    if (state_.run.time_step == 0.0) {
      // In the first step no rate reflects the impact velocity of bodies in initial contact yet.
      limit(first_step, TimeStepBound::first_step);
    } else {
      limit(control.maximum_growth * state_.run.unclipped_step, TimeStepBound::growth);
      // The step ends when bodies touch, and the next one is as small as the first of a run.
      limit(std::max(state_.run.first_touch - state_.run.time, first_step), TimeStepBound::first_touch);
    }
    require_positive();
    require_progress();
    if (!compression_is_followed_ && parallel::rank(state_.communicator) == 0) {
      state_.booked.held_time_steps += 1.0;
    }
    state_.run.unclipped_step = step_;
    const double left = until - state_.run.time;
    if (!(left > 0.0)) throw InternalError(fmt::format("t = {} s has been reached already", until));
    // The last step before `until` ends there; if less than two steps remain, they are made equal to avoid a tiny last
    // one.
    if (step_ < left && 2.0 * step_ > left) {
      limit(0.5 * left, TimeStepBound::output_time);
    } else {
      limit(left, TimeStepBound::output_time);
    }
    state_.run.time_step = step_;
    state_.time_step_bound = by_;
  });
}

void TimeStep::require_positive() const {
  if (step_ > 0.0 && std::isfinite(step_)) return;
  const std::string reason = fmt::format("the stable time step is {} s", step_);
  const Particles& particles = state_.particles;
  std::string error;
  for (std::size_t p = 0; p < particles.size() && error.empty(); ++p) {
    if (std::isfinite(particles.sound_speed[p] + particles.velocity[p].sum())) continue;
    error = state_.describe_particle(p, state_.run.time,
                                     fmt::format("{}; sound speed {} m/s", reason, particles.sound_speed[p]));
  }
  if (!parallel::any(state_.communicator, !error.empty())) {
    error = fmt::format("step {}, t = {} s: {}", state_.run.step, state_.run.time, reason);
  }
  parallel::throw_together(state_.communicator, error);
}

/// Ends a run whose steps have become so short that it would never end.
void TimeStep::require_progress() {
  RunState& run = state_.run;
  run.largest_step = std::max(run.largest_step, std::isfinite(cell_step_) ? cell_step_ : accurate_step_);
  if (run.time + step_ > run.time && step_ >= least_share_of_longest * run.largest_step) return;
  const std::string reason = fmt::format(
      "the time step has collapsed to {:.3g} s, the longest that a cell allowed was {:.3g} s; its bound: {}",
      step_, run.largest_step, word_of(by_));
  const Particles& particles = state_.particles;
  std::size_t fastest = particles.size();
  double speed = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double of_particle = particles.sound_speed[p] + particles.velocity[p].cwiseAbs().maxCoeff();
    if (of_particle > speed) {
      speed = of_particle;
      fastest = p;
    }
  }
  const double of_all = parallel::maximum(state_.communicator, speed);
  std::string error;
  if (!(of_all > 0.0)) {
    error = fmt::format("step {}, t = {} s: {}", run.step + 1, run.time, reason);
  } else if (speed == of_all) {
    error = state_.describe_particle(
        fastest, run.time, fmt::format("{}; the fastest: {:.6g} m/s with its sound speed", reason, speed));
  }
  parallel::throw_together(state_.communicator, error);
}

double TimeStep::element_bound() const {
  double dt = std::numeric_limits<double>::infinity();
  for (const Carrier* carrier : carriers_) dt = std::min(dt, carrier->critical_time_step());
  return state_.setup.time.element_safety * -parallel::maximum(state_.communicator, -dt);
}

/// Returns half the stability limit of the explicit diffusion of momentum and heat, dx^2 / (9 a) with the diffusivity
/// a, for any arrangement of particles: the squared gradients of quadratic B-splines over their values sum to at most
/// 18/dx^2 (docs/theory/conduction.md, equation 6).
double TimeStep::diffusive_bound() const {
  const double dx = state_.setup.domain.cell_size;
  const Particles& particles = state_.particles;
  double diffusivity = 0.0;
  for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
    const Material& material = *state_.setup.materials[b];
    const double viscosity = material.strength->viscosity();
    const double conduction = state_.setup.heat.conduction && material.conductivity > 0.0
                                  ? material.conductivity / material.reference.heat_capacity
                                  : 0.0;
    if (!(std::max(viscosity, conduction) > 0.0)) continue;
    const cases::BodySummary& body = state_.bodies[b];
    diffusivity = std::max(diffusivity, parallel::maximum(body.count, 0.0, [&](std::size_t i) {
                             const std::size_t p = body.first + i;
                             const double with_voids = particles.volume[p] + particles.void_volume[p];
                             return std::max(viscosity * particles.volume[p], conduction * with_voids) /
                                    particles.mass[p];
                           }));
  }
  diffusivity = parallel::maximum(state_.communicator, diffusivity);
  return diffusivity > 0.0 ? dx * dx / (18.0 * diffusivity) : std::numeric_limits<double>::infinity();
}

void TimeStep::take_rates() {
  const State::Rates rates = std::exchange(state_.rates, {});
  std::array<double, 3> fastest = {std::sqrt(rates.squared_change) / state_.run.time_step, rates.compression,
                                   rates.element_compression};
  parallel::maximum(state_.communicator, fastest);
  state_.run.maximum_acceleration = fastest[0];
  state_.run.compression_rate = std::max(compression_rate_of_most(fastest[1]), fastest[2]);
}

}  // namespace whipple::solver

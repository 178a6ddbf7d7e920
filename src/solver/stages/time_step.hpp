// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/carriers/particle_carrier.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

/// Computes the time step (s) that the Courant number allows for particles and for nodes of `State::transition`;
/// infinite without any motion with the grid. Collective.
double grid_time_step(const State& state, ParticleCarrier& particles);

/// Determines the time step: the minimum of a list of bounds (docs/theory/mpm.md, section 6).
class TimeStep {
 public:
  TimeStep(State& state, const Carriers& carriers, ParticleCarrier& particles)
      : state_(state), carriers_(carriers), particles_(particles) {}

  /// Computes the time step (s) that the state allows, regardless of the previous step. Collective.
  double accurate();
  /// Sets the time step, at most to the time `until` (s). Collective.
  /// @throws StateError without material in the domain, if there is no positive time step, or if it has collapsed
  void begin(double until);
  /// Stores the maximum rates of the step as bounds of the next one. Collective.
  void take_rates();

  /// Returns the time step that the state allowed in the current step, s.
  [[nodiscard]] double accurate_step() const { return accurate_step_; }

 private:
  /// Lowers the step to a bound.
  void limit(double bound, TimeStepBound by);
  [[nodiscard]] double diffusive_bound() const;
  [[nodiscard]] double element_bound() const;
  [[nodiscard]] double compression_rate_of_most(double largest) const;
  void require_positive() const;
  void require_progress();

  State& state_;
  const Carriers& carriers_;
  ParticleCarrier& particles_;
  double step_ = 0.0;                       // minimum of the bounds so far, s
  TimeStepBound by_ = TimeStepBound::none;  // the bound that determines it
  // Step in which nothing crosses more than a cell, s; infinite if nothing moves with the grid
  double cell_step_ = 0.0;
  double accurate_step_ = 0.0;
  bool compression_is_followed_ = true;  // whether that step satisfies `time.compression_limit`
};

}  // namespace whipple::solver

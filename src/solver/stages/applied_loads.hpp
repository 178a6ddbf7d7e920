// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/case/load.hpp"
#include "src/solver/carriers/carrier.hpp"
#include "src/solver/loads.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

/// Evaluates the loads of a case and its gravity (docs/theory/mpm.md, equations 3.5b to 3.5d): with the mean of their factor over each
/// step, so that a force gives exactly its impulse, whatever the steps.
class AppliedLoads {
 public:
  AppliedLoads(State& state, const Carriers& carriers);
  AppliedLoads(const AppliedLoads&) = delete;
  AppliedLoads& operator=(const AppliedLoads&) = delete;

  /// Adds the loads to those of the run, which must not outlive this object.
  void add_to(Loads& loads) const;
  /// Stores the mass on which each force acts at the start, `RunState::loaded_mass`. Collective.
  /// @throws InputError if there is none
  void weigh();
  /// Computes the accelerations of the step that begins. Collective if a force acts in it.
  void begin();
  /// Computes the accelerations at a time (s) instead, for states without inertia. Collective if a force acts then.
  void hold(double time);

 private:
  struct Applied {
    cases::AppliedLoad of;
    cases::LoadedRegion region;
    Vector3 force;                           // N, at a factor of 1
    Vector3 acceleration = Vector3::Zero();  // m/s^2, in this step
    double damping = 0.0;                    // 1/s, in this step
    bool everywhere = false;                 // gravity
  };
  [[nodiscard]] std::vector<double> masses() const;
  template <class Factor>
  void set(const Factor& factor, double dt);

  State& state_;
  const Carriers& carriers_;
  std::vector<Applied> applied_;
};

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/case/load.hpp"
#include "src/solver/carriers/carrier.hpp"
#include "src/solver/loads.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

/// Evaluates the loads of a case (docs/theory/mpm.md, equations 3.5b to 3.5d): with the mean of their factor over each
/// step, so that a force gives exactly its impulse, whatever the steps.
class AppliedLoads {
 public:
  AppliedLoads(const State& state, const Carriers& carriers);
  AppliedLoads(const AppliedLoads&) = delete;
  AppliedLoads& operator=(const AppliedLoads&) = delete;

  /// Adds the loads to those of the run, which must not outlive this object.
  void add_to(Loads& loads) const;
  /// Computes the accelerations of the step that begins, with the mass that each force acts on. Collective.
  void begin();

 private:
  struct Applied {
    const cases::AppliedLoad* of;
    cases::LoadedRegion region;
    Vector3 force;                           // N, at a factor of 1
    Vector3 acceleration = Vector3::Zero();  // m/s^2, in this step
    double damping = 0.0;                    // 1/s, in this step
  };
  void weigh(std::vector<double>& mass) const;

  const State& state_;
  const Carriers& carriers_;
  std::vector<Applied> applied_;
};

}  // namespace whipple::solver

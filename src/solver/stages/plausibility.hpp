// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/solver/carriers/carrier.hpp"

namespace whipple::solver {

/// Ends a run whose energy parts or speeds are impossible even if the sum of its energies is exact (docs/theory/mpm.md,
/// section 4): an erroneous gain of one part may be balanced by a loss of another that no balance monitors.
class Plausibility {
 public:
  Plausibility(State& state, const Carriers& carriers);

  /// Stores the initial values: `RunState::releasable_energy`, `reference_speed`. Collective.
  void begin();
  /// Checks the end of a step. Collective.
  /// @throws StateError with the energy part, its value and its bound; for speeds also with body and position
  void require() const;

 private:
  void require_parts() const;
  void require_speeds() const;
  [[nodiscard]] Vector3 frame() const;
  [[nodiscard]] double speed_by_loads() const;

  State& state_;
  const Carriers& carriers_;
  bool has_walls_;
  /// Acceleration (m/s^2) by each load of the case at a factor of 1, or force (N).
  std::vector<double> load_;
};

}  // namespace whipple::solver

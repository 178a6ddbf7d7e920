// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/carriers/carrier.hpp"

namespace whipple::solver {

/// Ends a run whose parts of energy or whose speeds are impossible, however exact the sum of its energies is
/// (docs/theory/mpm.md, section 4): a carrier that gives energy takes it from a part that no balance looks at.
class Plausibility {
 public:
  Plausibility(State& state, const Carriers& carriers);

  /// Notes what the run starts with: `RunState::releasable_energy`, `reference_speed`. Collective.
  void begin();
  /// Checks the end of a step. Collective.
  /// @throws StateError naming the part, its value and its bound; of speeds also the body and the place
  void require() const;

 private:
  void require_parts() const;
  void require_speeds() const;
  [[nodiscard]] Vector3 frame() const;

  State& state_;
  const Carriers& carriers_;
  bool has_walls_;
};

}  // namespace whipple::solver

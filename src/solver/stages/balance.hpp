// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/carriers/carrier.hpp"

namespace whipple::solver {

/// Totals of all carriers and the ledger of what changed them (docs/theory/mpm.md, section 4).
class Balance {
 public:
  Balance(State& state, const Carriers& carriers) : state_(state), carriers_(carriers) {}

  /// Sums totals, numbers and what the step accumulated over all ranks. Collective.
  void sum();
  /// Checks the total energy at the end of a step.
  /// @throws StateError if its error exceeds the limit of the case
  void require_energy() const;

 private:
  State& state_;
  const Carriers& carriers_;
};

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/carriers/carrier.hpp"

namespace whipple::solver {

/// Computes the totals of all carriers and updates the ledger of their changes (docs/theory/mpm.md, section 4).
class Balance {
 public:
  Balance(State& state, const Carriers& carriers) : state_(state), carriers_(carriers) {}

  /// Sums totals, numbers and the contributions of the step over all ranks. Collective.
  void sum();
  /// Checks the total energy at the end of a step.
  /// @throws StateError if its error exceeds the limit of the case
  void require_energy() const;

 private:
  State& state_;
  const Carriers& carriers_;
};

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/state.hpp"

namespace whipple::solver {

/// Watches whether material under pressure fills its cells (docs/theory/contact.md, 7).
class FillWatch {
 public:
  explicit FillWatch(State& state) : state_(state) {}

  /// Sums the intact material that is squeezed although its cells hold voids: a mark of bodies that act on each other
  /// across a gap, which energy and momentum do not show. Every 20 steps, after particles were binned. Collective.
  void look();
  /// Returns the least fraction of its cells that material of more than a pressure (Pa) fills; 1e300 without any.
  /// Collective.
  [[nodiscard]] double least(double pressure) const;

 private:
  State& state_;
  int looks_at_voids_ = 0;  // one after the other that found much material squeezed beside voids
  bool warned_ = false;
};

}  // namespace whipple::solver

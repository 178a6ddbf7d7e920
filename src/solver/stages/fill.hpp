// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/state.hpp"

namespace whipple::solver {

/// Monitors whether material under pressure fills its cells (docs/theory/contact.md, section 7).
class FillWatch {
 public:
  static constexpr double strong = 0.1;  ///< pressure over rho c^2 above which it counts
  static constexpr double filled =
      0.85;  ///< minimum fraction of the cells that material under pressure should fill

  explicit FillWatch(State& state) : state_(state) {}

  /// Sums the intact material under pressure whose cells contain voids: a sign of bodies that interact across a gap,
  /// which energy and momentum do not reveal. Acts every 20 steps; call after particles were binned. Collective.
  void look();
  /// Returns whether it acts in the present step.
  [[nodiscard]] bool is_due() const;
  /// Takes the mass (kg) of intact material under pressure whose cells contain voids, over all ranks.
  void judge(double mass);
  /// Returns the minimum fraction of its cells that material above a pressure (Pa) fills; 1e300 if there is none.
  /// Collective.
  [[nodiscard]] double least(double pressure) const;

 private:
  [[nodiscard]] double mass_beside_voids() const;

  State& state_;
  int looks_at_voids_ = 0;  // consecutive checks that found much compressed material next to voids
  bool warned_ = false;
};

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/carriers/carrier.hpp"

namespace whipple::solver {

/// Returns the energy (J/kg) that the material of a body may set free in all: what it holds in its initial state above
/// the zero of its equation of state, that of unburnt explosive included, and twice the elastic energy of its initial
/// pressure.
double releasable_energy(const cases::Body& body, const Material& material);

/// Ends a run whose parts of energy or whose speeds are impossible, however exact the sum of its energies is
/// (docs/theory/mpm.md, section 4): a carrier that gives energy takes it from a part that no balance looks at.
class Plausibility {
 public:
  Plausibility(const State& state, const Carriers& carriers);

  /// Checks the end of a step. Collective.
  /// @throws StateError naming the part, its value and its bound; of speeds also the particle or node
  void require() const;

 private:
  void require_parts() const;
  void require_speeds() const;
  [[nodiscard]] Vector3 frame() const;
  [[nodiscard]] double reference_speed(const Vector3& frame) const;

  const State& state_;
  const Carriers& carriers_;
  bool has_walls_;
};

}  // namespace whipple::solver

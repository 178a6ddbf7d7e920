// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/carriers/hexahedra.hpp"
#include "src/solver/stages/partition.hpp"

namespace whipple::solver {

/// Performs the stages of elements, their coupling to the grid and their conversion to particles
/// (docs/theory/afemp.md). Does nothing in a case without elements.
class ElementStage {
 public:
  ElementStage(State& state, const Carriers& carriers, ParticleCarrier& particles, Hexahedra& hexahedra,
               Partition& partition)
      : state_(state),
        carriers_(carriers),
        particles_(particles),
        hexahedra_(hexahedra),
        partition_(partition) {}

  /// Converts distorted elements to particles, and marks nodes near particles or other bodies, which move with the
  /// grid. Collective.
  /// @param contact  whether bodies have separate velocity fields
  void adapt(bool contact);
  /// Computes the forces of elements on their nodes. Collective.
  void compute_forces();
  /// Moves nodes, freely or with the motion of the grid, and updates their elements. Collective.
  /// @throws StateError on all ranks if an element on any rank is inverted or has no valid state
  void advance();

 private:
  [[nodiscard]] bool are_none() const { return carriers_.size() == 1; }  // particles only
  void collect();

  State& state_;
  const Carriers& carriers_;
  ParticleCarrier& particles_;
  Hexahedra& hexahedra_;
  Partition& partition_;
};

}  // namespace whipple::solver

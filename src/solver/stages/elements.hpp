// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/carriers/hexahedra.hpp"
#include "src/solver/stages/partition.hpp"

namespace whipple::solver {

/// Elements in the step, and their transition to the grid and to particles (docs/theory/afemp.md). Does nothing in a
/// case without elements.
class ElementStage {
 public:
  ElementStage(State& state, const Carriers& carriers, ParticleCarrier& particles, Hexahedra& hexahedra,
               Partition& partition)
      : state_(state),
        carriers_(carriers),
        particles_(particles),
        hexahedra_(hexahedra),
        partition_(partition) {}

  /// Turns distorted elements into particles; nodes at particles or at other bodies move with the grid. Collective.
  /// @param contact  have bodies velocity fields of their own?
  void adapt(bool contact);
  /// Computes the forces of elements on their nodes. Collective.
  void compute_forces();
  /// Moves nodes by themselves or as the grid moved them, and updates their elements. Collective.
  /// @throws StateError on all ranks, if an element is inverted or has no state on any
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "src/solver/carriers/particle_carrier.hpp"
#include "src/solver/stages/activity.hpp"

namespace whipple::solver {

/// Maintains the blocks of the grid and the distribution over ranks: blocks follow the material, particles are on the
/// rank of their block, elements on that of the block of their centre.
class Partition {
 public:
  Partition(State& state, const Carriers& carriers, ParticleCarrier& particles, Activity& activity)
      : state_(state), carriers_(carriers), particles_(particles), activity_(activity) {}

  /// Assigns particles and nodes of elements to blocks, adapts the blocks where necessary, and sorts the particles
  /// every 20 steps. Collective.
  void bin_particles();
  /// Sends elements to the ranks that own the blocks of their centres, if the forest was adapted since. Collective.
  void share_out_elements();

 private:
  [[nodiscard]] bool bin();
  void follow_particles();
  void adapt(std::span<const Vector3> positions, std::span<const Vector3> velocities, double lookahead);

  State& state_;
  const Carriers& carriers_;
  ParticleCarrier& particles_;
  Activity& activity_;
  std::vector<double> work_;      // of the particles (and elements), for the distribution
  bool elements_astray_ = false;  // the forest was adapted since elements were distributed
};

}  // namespace whipple::solver

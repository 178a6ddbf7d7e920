// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "src/solver/carriers/particle_carrier.hpp"
#include "src/solver/stages/activity.hpp"

namespace whipple::solver {

/// Blocks of the grid and what belongs to which rank: blocks follow the material, particles the blocks, and elements
/// the blocks of their centres.
class Partition {
 public:
  Partition(State& state, const Carriers& carriers, ParticleCarrier& particles, Activity& activity)
      : state_(state), carriers_(carriers), particles_(particles), activity_(activity) {}

  /// Assigns particles and nodes of elements to blocks, which follow them, and sorts the particles every 20 steps.
  /// Collective.
  void bin_particles();
  /// Sends elements to the ranks that own the blocks of their centres, if the forest was divided again. Collective.
  void share_out_elements();

 private:
  [[nodiscard]] bool bin();
  void follow_particles();
  void adapt(std::span<const Vector3> positions, std::span<const Vector3> velocities, double lookahead);

  State& state_;
  const Carriers& carriers_;
  ParticleCarrier& particles_;
  Activity& activity_;
  std::vector<double> work_;      // of the particles (and elements) for the parts of the ranks
  bool elements_astray_ = false;  // the forest was divided again since elements were
};

}  // namespace whipple::solver

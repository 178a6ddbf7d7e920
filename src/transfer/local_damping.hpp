// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/grid/block_grid.hpp"

namespace whipple::transfer {

/// Returns the factors of the components of a force by local damping (docs/theory/mpm.md, equation 3.5e): 1 - alpha
/// where the force drives the motion, 1 + alpha where it slows it, and 1 where the motion would end or reverse within
/// the step.
/// @param velocity   at the start of the step, m/s
/// @param increment  by the force in the step, m/s
inline Lanes damping_factor(double alpha, Lanes velocity, Lanes increment) {
  const Lanes driven = velocity * increment;
  const Lanes factor = select(driven > 0.0, broadcast(1.0 - alpha), broadcast(1.0 + alpha));
  const Lanes mean = velocity + 0.5 * factor * increment;
  return select((mean * velocity > 0.0) & (driven != 0.0), factor, broadcast(1.0));
}

/// Damps the motion of the nodes by a part of the force on each of them (3.5e): for states of rest, at which it ends. Its
/// work is never positive. Nodes at which bodies or walls may be in contact are left out: the force there is not yet
/// that of the step.
class LocalDamping {
 public:
  /// Finds the damping of this rank's nodes from their sums, which are complete, and shares it with the ranks that use
  /// them. Collective.
  /// @param alpha  0 <= alpha < 1
  void find(grid::BlockGrid& grid, double alpha, double dt);
  /// Adds it to the motion of this rank's nodes.
  void add(grid::BlockGrid& grid) const;
  /// Ends the damping of the step.
  void clear() { increment_.clear(); }

  /// Returns the increment of the velocity of each node that this rank uses, images beyond mirror planes included (m/s,
  /// lanes 0 to 2); empty: no damping in this step.
  [[nodiscard]] std::span<const Lanes> increments() const { return increment_; }
  /// Returns the impulse (N s) on the nodes of this rank apart from those near planes, whose particles count one by one
  /// (MirrorPlanes).
  [[nodiscard]] const Vector3& impulse() const { return impulse_; }
  /// Computes the work (J) on the nodes of this rank, when their motion is complete.
  [[nodiscard]] double work(const grid::BlockGrid& grid) const;

 private:
  struct Damped {
    std::uint32_t node;
    double mass;  // kg
  };
  void damp_slot(const grid::BlockGrid& grid, std::size_t slot, double alpha, double dt);
  void share(grid::BlockGrid& grid);

  std::vector<Lanes> increment_;             // of every node
  std::vector<std::vector<Damped>> damped_;  // of each slot of this rank
  std::vector<Vector3> of_slot_;             // impulse
  Vector3 impulse_ = Vector3::Zero();
  grid::SlotValues shared_;
};

}  // namespace whipple::transfer

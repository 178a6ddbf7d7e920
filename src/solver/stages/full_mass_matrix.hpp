// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/contact/grid_update.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_kind.hpp"

namespace whipple::solver {

/// Grid velocity by an approximate inverse of the full mass matrix, FMPM(k): Nairn & Hammerquist, Comput.
/// Methods Appl. Mech. Eng. 377 (2021) 113667; docs/theory/mpm.md, equations 5.8 and 5.9. A PIC update with
/// this velocity damps only what the particles' velocities hold and the grid cannot.
class FullMassMatrix {
 public:
  /// Replaces the velocity of the nodes after the forces by its FMPM value; the increment becomes zero. To be
  /// called after `GridUpdate::receive`, with the particles' positions of that transfer. Collective.
  /// @param order k >= 1; 1 leaves the velocity of the lumped masses
  /// @returns momentum that mirror planes and walls give to the particles by it (N s, part of this rank)
  Vector3 apply(transfer::ShapeFunction shape, const Particles& particles, grid::BlockGrid& grid,
                contact::GridUpdate& update, int order);

 private:
  std::vector<Vector3> at_particles_;
  std::vector<Lanes> term_;
};

}  // namespace whipple::solver

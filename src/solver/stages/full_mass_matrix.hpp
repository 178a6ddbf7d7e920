// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/contact/grid_update.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_kind.hpp"

namespace whipple::solver {

/// Computes the grid velocity with an approximate inverse of the full mass matrix, FMPM(k): Nairn & Hammerquist,
/// Comput. Methods Appl. Mech. Eng. 377 (2021) 113667; docs/theory/mpm.md, equations 5.8 and 5.9. A PIC update with
/// this velocity damps only the part of the particle velocities that the grid cannot represent.
class FullMassMatrix {
 public:
  /// Replaces the velocity of the nodes after the forces by its FMPM value and sets the increment to zero. Call after
  /// `GridUpdate::receive`, with the particle positions of that transfer. Collective.
  /// @param order k >= 1; 1 keeps the velocity of the lumped masses
  /// @returns momentum that mirror planes and walls give to the particles of this rank by the correction, N s
  Vector3 apply(transfer::ShapeFunction shape, const Particles& particles, grid::BlockGrid& grid,
                contact::GridUpdate& update, int order);

 private:
  std::vector<Vector3> at_particles_;
  std::vector<Lanes> term_;
};

}  // namespace whipple::solver

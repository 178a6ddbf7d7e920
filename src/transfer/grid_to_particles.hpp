// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple::transfer {

/// Sums over the particles of one transfer (J).
struct TransferBalance {
  double work = 0.0;  ///< of the stress on the strain of the mean grid velocity: internal energy gained
  double heat = 0.0;  ///< kinetic energy lost in the transfer and returned as heat, >= 0
  TransferBalance& operator+=(const TransferBalance& other) {
    work += other.work;
    heat += other.heat;
    return *this;
  }
};

/// The gather of the symplectic scheme (docs/theory/mpm.md, section 4): velocity and affine field by the
/// relaxed affine transfer, internal energy by the exact work identity plus the heat of the transfer,
/// position with the grid's velocity, and the velocity gradient of the advanced grid for the constitutive
/// update.
/// @param affine            carry the affine field (quadratic B-splines only); false: FLIP
/// @param velocity_gradient out, one per particle, 1/s: L(i, j) = dv_i/dx_j
template <class Shape>
TransferBalance grid_to_particles(Particles& particles, grid::BlockGrid& grid, double dt, bool affine,
                                  std::span<Matrix3> velocity_gradient);

/// First gather of MUSL: FLIP increment of the velocity, and the displacement of the step (not yet applied).
template <class Shape>
void increment_velocity(Particles& particles, grid::BlockGrid& grid, double dt,
                        std::span<Vector3> displacement);

/// Velocity gradient of the nodes' velocities (Node::first).
template <class Shape>
void gather_velocity_gradient(const Particles& particles, grid::BlockGrid& grid,
                              std::span<Matrix3> velocity_gradient);

}  // namespace whipple::transfer

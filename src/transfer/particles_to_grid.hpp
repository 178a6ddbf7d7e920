// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_kind.hpp"

namespace whipple::transfer {

/// Mass, momentum (with the affine field), force and mass-weighted sound speed of the particles on the nodes
/// (docs/theory/mpm.md, equations 3.1 to 3.3). Clears the grid first; mirror planes are not folded yet. The
/// result is bitwise independent of the number of threads.
/// @param acceleration by external forces (m/s^2), one per particle; empty: none
/// @param at_border    called when what other ranks wait for is complete (grid::BlockGrid::Region)
void particles_to_grid(const ShapeFunctions& functions, const Particles& particles, grid::BlockGrid& grid,
                       std::span<const Vector3> acceleration = {},
                       const std::function<void()>& at_border = {});

/// Computes the force (N) of the hoop stress of all rings of this rank towards the axis, the sum of V sigma_zz / r: it
/// changes the radial momentum, which is no invariant.
double hoop_force(const Particles& particles, const grid::BlockGrid& grid);

/// Mass and momentum only, with a velocity per particle: NodeSums::mass_and_momentum is replaced, the other register
/// stays (equations 5.3, 5.9).
void momentum_to_grid(ShapeFunction shape, const Particles& particles, std::span<const Vector3> velocity,
                      grid::BlockGrid& grid, const std::function<void()>& at_border = {});

}  // namespace whipple::transfer

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_kind.hpp"
#include "src/transfer/sweep.hpp"

namespace whipple::transfer {

/// Adds mass, momentum (with the affine field), force and mass-weighted sound speed of the particles of a region to the
/// nodes (docs/theory/mpm.md, equations 3.1 to 3.3), which BlockGrid::clear has cleared; mirror planes are not folded
/// yet. The border comes first: other ranks wait for it. The result is bitwise independent of the number of threads.
/// @param acceleration by external forces (m/s^2), one per particle; empty: none
/// @param mean_stress  Pa, of each particle, as `average_stress` computes it; empty: that of its own pressure
void particles_to_grid(const ShapeFunctions& functions, const Particles& particles, grid::BlockGrid& grid,
                       Region region, std::span<const Vector3> acceleration = {},
                       std::span<const double> mean_stress = {});

/// Computes the force (N) of the hoop stress of all rings of this rank towards the axis, the sum of V sigma_zz / r: it
/// changes the radial momentum, which is no invariant.
/// @param mean_stress  as that of `particles_to_grid`
double hoop_force(const Particles& particles, const grid::BlockGrid& grid,
                  std::span<const double> mean_stress = {});

/// Clears mass and momentum of the nodes; the other register stays.
void clear_momentum(grid::BlockGrid& grid);
/// Adds mass and momentum of the particles of a region to nodes whose momentum has been cleared, with a velocity per
/// particle (equations 5.3, 5.9).
void momentum_to_grid(ShapeFunction shape, const Particles& particles, std::span<const Vector3> velocity,
                      grid::BlockGrid& grid, Region region);

}  // namespace whipple::transfer

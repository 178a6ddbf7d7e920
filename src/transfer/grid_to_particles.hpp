// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/losses.hpp"
#include "src/transfer/point_values.hpp"
#include "src/transfer/shape_kind.hpp"
#include "src/transfer/sweep.hpp"

namespace whipple::transfer {

/// Settings of the gather of the symplectic scheme.
struct ExactUpdate {
  ShapeFunctions functions;
  double dt;           ///< s
  AffineField affine;  ///< B-splines only, unless `none`
  Losses losses;
  std::span<const Vector3> acceleration;  ///< by external forces, as given to `particles_to_grid`
};

/// Updates the particles of a stretch by the advanced grid (docs/theory/mpm.md, section 4): velocity and affine field by
/// the relaxed affine transfer, internal and unresolved energy by the exact work identity and the transfer dissipation,
/// position with the grid's velocity. Leaves the velocity gradients of the advanced grid, which strain the material, and
/// the sums of the slots in the stretch.
void grid_to_particles(const ExactUpdate& update, Particles& particles, grid::BlockGrid& grid,
                       const Stretch& stretch);

/// Contents of `Stretch::gradients` after a gather.
enum class Gradients : std::uint8_t {
  none,              ///< nothing
  of_grid_velocity,  ///< velocity gradients of the advanced grid
};

/// Settings of the gather of the schemes without exact energy.
struct RelaxedUpdate {
  ShapeFunctions functions;
  double dt;          ///< s
  double relaxation;  ///< towards the grid's velocity: 0 FLIP, 1 PIC
  Gradients gradients;
  std::span<const Vector3> acceleration;  ///< by external forces, as given to `particles_to_grid`
};

/// Updates velocity and position of the particles of a stretch (equations 5.1, 5.2). Leaves external work and largest
/// change of the slots in the stretch.
void update_velocity(const RelaxedUpdate& update, Particles& particles, grid::BlockGrid& grid,
                     const Stretch& stretch);

/// Gathers the gradients of the nodes' velocities (NodeMotion::velocity) for the particles of a stretch.
void gather_velocity_gradient(const ShapeFunctions& functions, const Particles& particles,
                              grid::BlockGrid& grid, const Stretch& stretch);

/// Gathers the nodes' velocities (NodeMotion::velocity) for all particles.
void gather_velocity(ShapeFunction shape, const Particles& particles, grid::BlockGrid& grid,
                     std::span<Vector3> velocity);

}  // namespace whipple::transfer

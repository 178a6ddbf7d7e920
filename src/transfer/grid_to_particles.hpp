// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/losses.hpp"
#include "src/transfer/shape_kind.hpp"

namespace whipple::transfer {

/// Sums over the particles of one transfer.
struct TransferBalance {
  double work = 0.0;            ///< J, of the stress on the strain of the mean grid velocity
  double viscous_work = 0.0;    ///< J, part of it: of the artificial viscosity
  double heat = 0.0;            ///< J, kinetic energy lost in the transfer that became heat at once, >= 0
  double kept = 0.0;            ///< J, the rest of the loss, now unresolved energy, >= 0
  double returned = 0.0;        ///< J, unresolved energy that became heat, >= 0
  double plastic_work = 0.0;    ///< J, as those report it who take the gradients
  double external_work = 0.0;   ///< J, of the external acceleration, on the mean grid velocity
  double squared_change = 0.0;  ///< m^2/s^2, the largest of any particle's velocity; no sum
  TransferBalance& operator+=(const TransferBalance& other) {
    work += other.work;
    viscous_work += other.viscous_work;
    heat += other.heat;
    kept += other.kept;
    returned += other.returned;
    plastic_work += other.plastic_work;
    external_work += other.external_work;
    squared_change = std::max(squared_change, other.squared_change);
    return *this;
  }
};

/// Update of the affine fields of the particles.
enum class AffineField : std::uint8_t {
  none,      ///< there is none: FLIP, PIC and their blends
  deformed,  ///< carried to the new positions with the deformation of the step, never growing
  turned,    ///< turned with the rotation of the step only, which changes no energy
};

/// Takes the velocity gradients L(i, j) = dv_i/dx_j (1/s) of some particles while these are still in the
/// cache: gradient k belongs to particle particles[k]. Every particle of the lists of the grid comes once, in
/// any order, on any thread; particles of one block in the order of their index. Returns their plastic work
/// (J).
using TakeGradients =
    std::function<double(std::span<const std::uint32_t> particles, std::span<const Matrix3> gradients)>;

/// Called between the particles of the interior and those of the border (grid::BlockGrid::Region), whose
/// nodes may be under way from other ranks until then; empty: nothing to wait for.
using BeforeBorder = std::function<void()>;

/// The gather of the symplectic scheme (docs/theory/mpm.md, section 4): velocity and affine field by the
/// relaxed affine transfer, internal and unresolved energy by the exact work identity and what the transfer
/// loses, position with the grid's velocity, and the velocity gradient of the advanced grid for the
/// constitutive update.
/// @param affine        B-splines only, unless `none`
/// @param losses        what becomes of them; if kept, the particles carry unresolved energy and closing rate
/// @param take          the gradients of the advanced grid velocity; may change its particles
/// @param acceleration  by external forces, as given to `particles_to_grid`
TransferBalance grid_to_particles(const ShapeFunctions& functions, Particles& particles,
                                  grid::BlockGrid& grid, double dt, AffineField affine, const Losses& losses,
                                  const TakeGradients& take, std::span<const Vector3> acceleration = {},
                                  const BeforeBorder& before_border = {});

/// Gather of the schemes without exact energy (equations 5.1, 5.2): velocity and position.
/// @param relaxation    towards the grid's velocity: 0 FLIP, 1 PIC
/// @param take          the gradients of the advanced grid velocity; empty if they are not wanted
/// @returns external work and largest change
TransferBalance update_velocity(const ShapeFunctions& functions, Particles& particles, grid::BlockGrid& grid,
                                double dt, double relaxation, const TakeGradients& take,
                                std::span<const Vector3> acceleration = {},
                                const BeforeBorder& before_border = {});

/// Velocity gradient of the nodes' velocities (NodeMotion::velocity). @returns J, plastic work, as `take` reports it
double gather_velocity_gradient(const ShapeFunctions& functions, const Particles& particles,
                                grid::BlockGrid& grid, const TakeGradients& take,
                                const BeforeBorder& before_border = {});

/// The nodes' velocities (NodeMotion::velocity) at the particles.
void gather_velocity(ShapeFunction shape, const Particles& particles, grid::BlockGrid& grid,
                     std::span<Vector3> velocity);

}  // namespace whipple::transfer

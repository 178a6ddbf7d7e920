// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "src/grid/block_grid.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/shape_kind.hpp"

namespace whipple::transfer {

/// Nodes of finite elements that move with the grid (docs/theory/afemp.md, section 2): like particles they
/// have mass, velocity and affine field, but instead of a stress the force that their elements exert on them.
/// They are the off-grid points of the grid, in the order in which `BlockGrid::bin` was given them.
struct TransitionNodes {
  /// The first so many carry no affine field, and no node of the grid that they reach relaxes anybody
  /// (docs/theory/afemp.md, 2); the others are relaxed as particles are.
  std::size_t unrelaxed = 0;
  std::vector<double> mass;              ///< kg
  std::vector<double> sound_speed;       ///< m/s, of the elements around
  std::vector<Vector3> position;         ///< m
  std::vector<Vector3> velocity;         ///< m/s
  std::vector<Matrix3> affine_velocity;  ///< 1/s
  std::vector<Vector3> force;            ///< N
  // What the grid makes of them:
  std::vector<Vector3> mean_velocity;  ///< m/s, of the grid at the node, mean of before and after the forces
  std::vector<Vector3> new_velocity;   ///< m/s, the same after the forces: strains elements, moves the node
  std::vector<double> heat;            ///< J, kinetic energy lost in the transfer, >= 0
  std::vector<double> contact_heat;    ///< J, the same in contact with other bodies

  [[nodiscard]] std::size_t size() const { return mass.size(); }
  void resize(std::size_t n);
};

/// Adds mass, momentum, mass-weighted sound speed and forces of the nodes of a region to the grid, after its particles.
/// B-splines only. The result is bitwise independent of the number of threads.
void nodes_to_grid(ShapeFunction shape, const TransitionNodes& nodes, grid::BlockGrid& grid, Region region);

/// Velocity, affine field and position of the nodes by the transfer of the particles (docs/theory/mpm.md,
/// equations 4.3 to 4.5, 4.8; docs/theory/afemp.md, 2), and what their elements need of the grid. B-splines
/// only.
/// @param affine as of `ExactUpdate`
void grid_to_nodes(const ShapeFunctions& functions, TransitionNodes& nodes, grid::BlockGrid& grid, double dt,
                   AffineField affine);

}  // namespace whipple::transfer

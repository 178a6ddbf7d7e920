// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "src/contact/grid_update.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/particles_to_grid.hpp"
#include "src/transfer/shape_function.hpp"
#include "src/transfer/sweep.hpp"
#include "src/transfer/transition_nodes.hpp"

/// Random particles and a grid for them.
namespace whipple::transfer {

inline constexpr double dx = 0.5;

inline grid::Geometry geometry(std::array<grid::Boundary, 6> boundary = {}) {
  return {.lower = Vector3(-2, -1, 3),
          .cells = {22, 17, 19},
          .cell_size = dx,
          .boundary = boundary,
          .levels = {}};
}

inline SymmetricTensor random_stress(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random), normal(random), normal(random), normal(random)};
}

/// Functions of a shape, quadratic ones with slopes smoothed by some share: every identity holds for any.
template <class Shape>
ShapeFunctions smoothed(double smoothing = 1.3) {
  return {Shape::kind, smoothing};
}

/// Regions in the order in which points bring something to the nodes, and in which they take something.
constexpr std::array scatter_order = {Region::border, Region::interior};
constexpr std::array gather_order = {Region::interior, Region::border};

/// Clears the grid and adds all particles to it.
inline void particles_to_grid(const ShapeFunctions& functions, const Particles& q, grid::BlockGrid& grid,
                              std::span<const Vector3> acceleration = {}) {
  grid.clear();
  for (const Region region : scatter_order) particles_to_grid(functions, q, grid, region, acceleration);
}
/// Adds nodes of elements to the grid.
inline void nodes_to_grid(ShapeFunction shape, const TransitionNodes& nodes, grid::BlockGrid& grid) {
  for (const Region region : scatter_order) nodes_to_grid(shape, nodes, grid, region);
}
/// Replaces mass and momentum of the nodes.
inline void momentum_to_grid(ShapeFunction shape, const Particles& q, std::span<const Vector3> velocity,
                             grid::BlockGrid& grid) {
  clear_momentum(grid);
  for (const Region region : scatter_order) momentum_to_grid(shape, q, velocity, grid, region);
}

/// Impulse of an advance of the nodes of one rank, and kinetic energy of the particles' share of the nodes (J).
struct GridBalance {
  Vector3 wall_impulse = Vector3::Zero();
  double before = 0.0, after = 0.0;
};
/// Advances the nodes of one rank, without contact of bodies. A node beyond a mirror plane moves as the image of its
/// mirror node, so that the masses before the fold give the energies after it.
inline GridBalance advance(contact::GridUpdate& update, grid::BlockGrid& grid, double dt,
                           const Relaxation& relaxation) {
  std::vector<double> mass;
  for (const grid::Node& node : grid.all_nodes()) mass.push_back(node.sums.mass());
  update.solve_momentum(grid, dt, relaxation);
  GridBalance balance{.wall_impulse = update.share_step(grid)};
  balance.wall_impulse += update.receive(grid);
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const grid::NodeMotion& motion = grid.all_nodes()[i].motion;
    balance.before += 0.5 * mass[i] * motion.velocity().squaredNorm();
    balance.after += 0.5 * mass[i] * (motion.velocity() + motion.increment()).squaredNorm();
  }
  return balance;
}
inline GridBalance advance(grid::BlockGrid& grid, double dt, const Relaxation& relaxation) {
  contact::GridUpdate update;
  return advance(update, grid, dt, relaxation);
}

/// Gathers for all particles.
/// @param gather  gather(stretch)
/// @returns sums over the particles; `gradients` with one per particle
template <class Gather>
TransferBalance sweep_all(grid::BlockGrid& grid, std::vector<Matrix3>& gradients, Gather&& gather) {
  Sweep sweep(grid);
  for (const Region region : gather_order) {
    sweep.for_each_stretch(region, [&](const Stretch& stretch) {
      gather(stretch);
      for (std::size_t k = 0; k < stretch.particles.size(); ++k) {
        gradients[stretch.particles[k]] = stretch.gradients[k];
      }
    });
  }
  return sweep.balance();
}
inline TransferBalance grid_to_particles(const ExactUpdate& update, Particles& q, grid::BlockGrid& grid,
                                         std::vector<Matrix3>& gradients) {
  return sweep_all(grid, gradients,
                   [&](const Stretch& stretch) { grid_to_particles(update, q, grid, stretch); });
}
inline TransferBalance update_velocity(const RelaxedUpdate& update, Particles& q, grid::BlockGrid& grid,
                                       std::vector<Matrix3>& gradients) {
  return sweep_all(grid, gradients,
                   [&](const Stretch& stretch) { update_velocity(update, q, grid, stretch); });
}
inline void gather_velocity_gradient(const ShapeFunctions& functions, const Particles& q,
                                     grid::BlockGrid& grid, std::vector<Matrix3>& gradients) {
  sweep_all(grid, gradients,
            [&](const Stretch& stretch) { gather_velocity_gradient(functions, q, grid, stretch); });
}

/// Particles with random state between two corners; a third of them in one dense block, the rest scattered,
/// so that both accesses to the nodes are used.
inline Particles random_particles(std::size_t n, const Vector3& lower, const Vector3& upper, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  Particles q;
  resize(q, n);
  q.affine_velocity.resize(n);
  q.extent.resize(n);
  for (std::size_t p = 0; p < n; ++p) {
    q.id[p] = p;
    const double share = p % 3 == 0 ? 0.1 : 1.0;
    for (int a = 0; a < 3; ++a) q.position[p][a] = lower[a] + share * uniform(random) * (upper[a] - lower[a]);
    q.mass[p] = 0.5 + uniform(random);
    q.volume[p] = 0.01 * (0.5 + uniform(random));
    q.velocity[p] = Vector3(normal(random), normal(random), normal(random));
    for (int i = 0; i < 9; ++i) q.affine_velocity[p].data()[i] = normal(random);
    q.deviatoric_stress[p] = random_stress(random);
    q.pressure[p] = normal(random);
    q.artificial_viscosity[p] = uniform(random);
    q.sound_speed[p] = 1.0 + uniform(random);
    q.specific_internal_energy[p] = normal(random);
    const double h = (0.1 + 0.4 * uniform(random)) * dx;
    q.extent[p] = {h * h, 0.8 * h * h, 0.3 * h * h, 0, 0, 0};
  }
  return q;
}

template <class Shape>
void bin(grid::BlockGrid& grid, const Particles& q) {
  if (grid.bin(q.position, Shape::stencil)) return;
  grid.adapt(q.position, q.velocity, 0.0, Shape::stencil);
  grid.activate(q.position, q.velocity, 0.0, Shape::stencil);
  ASSERT_TRUE(grid.bin(q.position, Shape::stencil));
}

}  // namespace whipple::transfer

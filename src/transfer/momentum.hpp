// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/grid/block_grid.hpp"

/// The momentum equation at the nodes of this rank (docs/theory/mpm.md, 3).
namespace whipple::transfer {

constexpr double no_mass = 1e-300;  ///< kg; below it momentum / mass may overflow

/// Rate at which a step relaxes the affine fields of the particles towards the grid velocity
/// (docs/theory/mpm.md, 4).
struct Relaxation {
  /// beta = 1 - exp(-kappa c dt / dx) with the node's sound speed c; the result is the same for every time step.
  double kappa = 0.2;
  /// beta itself, per step, instead: 0 is FLIP, 1 is APIC. Negative: use kappa.
  double fixed = -1.0;
};

/// Returns beta of the nodes of a block; 0 where there is no mass, and where nodes of elements made the sum of the sound
/// speeds negative (docs/theory/afemp.md, 2).
/// @param rate  kappa dt / dx, s/m
std::array<double, grid::nodes_per_block> relaxation_of(const grid::Node* nodes, const Relaxation& relaxation,
                                                        double rate);

/// Solves m dv/dt = f (equation 3.4) at the nodes of this rank, whose sums are complete: NodeSums before, NodeMotion
/// after.
/// @param keeps_mass  keeps_mass(block of nodes): contact follows, for which NodeMotion holds the mass in place of heat
template <class KeepsMass>
void solve_momentum(grid::BlockGrid& grid, double dt, const Relaxation& relaxation,
                    const KeepsMass& keeps_mass) {
  const std::span<grid::Node> nodes = grid.all_nodes();
  parallel::for_each(grid.owned_blocks(), [&](std::size_t b) {
    const std::size_t block = grid.owned_block(b);
    const std::size_t first = block * grid::nodes_per_block;
    const double mass_kept = keeps_mass(block) ? 1.0 : 0.0;
    const double rate = relaxation.kappa * dt / grid.geometry_of_node(first).cell_size;
    const std::array<double, grid::nodes_per_block> betas = relaxation_of(&nodes[first], relaxation, rate);
    for (std::size_t i = first; i < first + grid::nodes_per_block; ++i) {
      grid::Node& node = nodes[i];
      const double mass = node.sums.mass();
      if (mass < no_mass || grid.is_image(i)) {
        node.registers = {broadcast(0.0), broadcast(0.0)};
        continue;
      }
      const double beta = betas[i - first];
      const Lanes velocity = node.sums.mass_and_momentum / mass;
      const Lanes increment = node.sums.sound_and_force * (dt / mass);
      const Lanes v = {velocity[1], velocity[2], velocity[3], beta},
                  d = {increment[1], increment[2], increment[3], mass_kept * mass};
      node.motion = {v, d};
    }
  });
}

/// Divides momentum by mass in the first register of the nodes of this rank, whose sums are complete.
/// @param keeps_mass  keeps_mass(block of nodes): contact follows, for which lane 3 holds the mass
template <class KeepsMass>
void solve_velocity(grid::BlockGrid& grid, const KeepsMass& keeps_mass) {
  const std::span<grid::Node> nodes = grid.all_nodes();
  parallel::for_each(grid.owned_blocks(), [&](std::size_t b) {
    const std::size_t block = grid.owned_block(b), begin = block * grid::nodes_per_block;
    const double mass_kept = keeps_mass(block) ? 1.0 : 0.0;
    for (std::size_t i = begin; i < begin + grid::nodes_per_block; ++i) {
      Lanes& first = nodes[i].registers.first;  // mass and momentum, then velocity
      const double mass = first[0];
      if (mass < no_mass || grid.is_image(i)) {
        first = broadcast(0.0);
      } else {
        first = Lanes{first[1], first[2], first[3], 0.0} / mass;
        first[3] = mass_kept * mass;
      }
    }
  });
}

}  // namespace whipple::transfer

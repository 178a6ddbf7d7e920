// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/full_mass_matrix.hpp"

#include "src/core/parallel/threads.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/particles_to_grid.hpp"

namespace whipple::solver {
namespace {

struct SumOfMomenta {
  Vector3 sum = Vector3::Zero();
  SumOfMomenta& operator+=(const SumOfMomenta& other) {
    sum += other.sum;
    return *this;
  }
};

Vector3 momentum(const Particles& particles, std::span<const Vector3> velocity) {
  return parallel::sum<SumOfMomenta>(
             particles.size(), [&](std::size_t p) { return SumOfMomenta{particles.mass[p] * velocity[p]}; })
      .sum;
}

}  // namespace

Vector3 FullMassMatrix::apply(transfer::ShapeFunction shape, const Particles& particles,
                              grid::BlockGrid& grid, contact::GridUpdate& update, int order) {
  const std::span<grid::Node> nodes = grid.all_nodes();
  // The first register holds the term v*_l of the series (5.9), the second the partial sum.
  parallel::for_each(nodes.size(), [&](std::size_t i) {
    nodes[i].registers.second += Lanes{1.0, 1.0, 1.0, 0.0} * nodes[i].registers.first;
    nodes[i].registers.first = nodes[i].registers.second;
  });
  at_particles_.assign(particles.size(), Vector3::Zero());  // remains zero where the grid does not reach
  term_.resize(nodes.size());
  // Without planes the series conserves momentum; the change with planes is their impulse.
  const bool planes = !grid.mirror_planes().empty();
  Vector3 impulse = Vector3::Zero();
  for (int l = 2; l <= order; ++l) {
    transfer::gather_velocity(shape, particles, grid, at_particles_);
    if (planes && l == 2) impulse -= momentum(particles, at_particles_);
    parallel::for_each(nodes.size(), [&](std::size_t i) { term_[i] = nodes[i].registers.first; });
    transfer::clear_momentum(grid);
    for (const auto region : {transfer::Region::border, transfer::Region::interior}) {
      transfer::momentum_to_grid(shape, particles, at_particles_, grid, region);
    }
    update.solve_velocity(grid);
    update.receive(grid);  // sum over particles and nodes of N_i m N_j v*_j / m_i
    parallel::for_each(nodes.size(), [&](std::size_t i) {
      nodes[i].registers.first = term_[i] - nodes[i].registers.first;
      nodes[i].registers.second += Lanes{1.0, 1.0, 1.0, 0.0} * nodes[i].registers.first;
    });
  }
  parallel::for_each(nodes.size(), [&](std::size_t i) {
    nodes[i].registers.first = Lanes{1.0, 1.0, 1.0, 0.0} * nodes[i].registers.second;
    nodes[i].registers.second = broadcast(0.0);
  });
  if (planes && order >= 2) {
    transfer::gather_velocity(shape, particles, grid, at_particles_);
    impulse += momentum(particles, at_particles_);
  }
  return impulse;
}

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_function.hpp"

/// Random particles and a grid for them.
namespace whipple::transfer {

inline constexpr double dx = 0.5;

inline grid::Geometry geometry(std::array<grid::Boundary, 6> boundary = {}) {
  return {.lower = Vector3(-2, -1, 3), .cells = {22, 17, 19}, .cell_size = dx, .boundary = boundary};
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

/// Takes gradients into an array with one per particle.
inline auto into(std::vector<Matrix3>& all) {
  return [&all](std::span<const std::uint32_t> particles, std::span<const Matrix3> gradients) {
    for (std::size_t k = 0; k < particles.size(); ++k) all[particles[k]] = gradients[k];
    return 0.0;
  };
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

// SPDX-License-Identifier: BSD-3-Clause
// The loops of the transfers: gradients are right, either set of registers gives the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/contact/grid_update.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/kernels.hpp"
#include "src/transfer/particles_to_grid.hpp"
#include "src/transfer/transition_nodes.hpp"
#include "tests/property/transfer_support.hpp"

namespace whipple::transfer {
namespace {

template <class Shape>
class TransferKernels : public testing::Test {};
using Shapes = testing::Types<Linear, Gimp, ConvectedGimp, QuadraticBSpline, CubicBSpline>;
TYPED_TEST_SUITE(TransferKernels, Shapes);

/// Gradients of a velocity field that is linear in space are left at every particle; and the largest change of a velocity.
TYPED_TEST(TransferKernels, GradientsAreRightAtEveryParticle) {
  Particles q = random_particles(3000, Vector3(-1.2, -0.3, 4), Vector3(8, 6.5, 11.8), 5);
  grid::BlockGrid grid(geometry(), parallel::world());
  bin<TypeParam>(grid, q);
  const Matrix3 field{{0.3, -1.0, 0.2}, {0.7, 0.1, -0.4}, {-0.6, 0.5, 0.9}};
  particles_to_grid(smoothed<TypeParam>(), q, grid);  // for the masses
  advance(grid, 0.0, {});
  for (std::size_t s = 0; s < grid.slots(); ++s) {
    for (int i = 0; i < grid::nodes_per_block; ++i) {
      const grid::BlockCoordinate& c = grid.coordinate(s);
      const Vector3 place(c[0] * 4 + i / 16, c[1] * 4 + i / 4 % 4, c[2] * 4 + i % 4), v = field * dx * place;
      grid.nodes(s)[i].motion.velocity_and_relaxation = Lanes{v[0], v[1], v[2], 0.0};
      grid.nodes(s)[i].motion.increment_and_heat = Lanes{1.0, -2.0, 2.0, 0.0};  // increment
    }
  }
  const auto worst = [&](const std::vector<Matrix3>& gradients) {
    double largest = 0.0;
    for (const Matrix3& gradient : gradients) {
      largest = std::max(largest, (gradient - field).cwiseAbs().maxCoeff());
    }
    return largest;
  };
  std::vector<Matrix3> gradients(q.size(), Matrix3::Zero());
  gather_velocity_gradient(smoothed<TypeParam>(), q, grid, gradients);
  EXPECT_LT(worst(gradients), 1e-12);

  std::ranges::fill(gradients, Matrix3::Zero().eval());
  const TransferBalance flip = update_velocity(
      {smoothed<TypeParam>(), 0.05, 0.0, Gradients::of_grid_velocity, {}}, q, grid, gradients);
  EXPECT_LT(worst(gradients), 1e-12);
  EXPECT_NEAR(flip.squared_change, 9.0, 1e-11);
}

/// What a cycle of all transfers makes of particles and nodes of elements, some of which carry no affine
/// field: every number of it.
template <class Shape>
std::vector<double> numbers_after_all_transfers(KernelSet set, AffineField affine = AffineField::deformed) {
  const KernelSet in_use = std::exchange(kernel_set(), set);
  constexpr double dt = 0.05;
  Particles q = random_particles(701, Vector3(-1.2, -0.3, 4), Vector3(8, 6.5, 11.8), 21);
  const Particles guests = random_particles(93, Vector3(0, 0, 4.5), Vector3(4, 5, 9), 22);
  TransitionNodes nodes;
  nodes.resize(CarriesAffineField<Shape> ? guests.size() : 0);
  nodes.unrelaxed = nodes.size() / 3;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    nodes.mass[n] = guests.mass[n];
    nodes.sound_speed[n] = guests.sound_speed[n];
    nodes.position[n] = guests.position[n];
    nodes.velocity[n] = guests.velocity[n];
    nodes.affine_velocity[n] = n < nodes.unrelaxed ? Matrix3(Matrix3::Zero()) : guests.affine_velocity[n];
    nodes.force[n] = guests.affine_velocity[n].col(1);
  }
  grid::BlockGrid grid(geometry(), parallel::world());
  std::vector<Vector3> all = q.position, moving = q.velocity;
  all.insert(all.end(), nodes.position.begin(), nodes.position.end());
  moving.insert(moving.end(), nodes.velocity.begin(), nodes.velocity.end());
  grid.adapt(all, moving, 0.0, Shape::stencil);
  grid.activate(all, moving, 0.0, Shape::stencil, nodes.size());
  EXPECT_TRUE(grid.bin(q.position, Shape::stencil, nodes.position));

  std::vector<double> numbers;
  const auto take = [&](const auto& values) {
    for (const auto& value : values) {
      const auto* from = reinterpret_cast<const double*>(&value);
      numbers.insert(numbers.end(), from, from + sizeof(value) / sizeof(double));
    }
  };
  const auto to_grid_and_advance = [&] {
    particles_to_grid(smoothed<Shape>(), q, grid);
    if (nodes.size() > 0) nodes_to_grid(Shape::kind, nodes, grid);
    take(grid.all_nodes());
    advance(grid, dt, {.kappa = 0.7});
  };
  std::vector<Matrix3> gradient(q.size());
  to_grid_and_advance();
  take(std::array{
      update_velocity({smoothed<Shape>(), dt, 0.1, Gradients::of_grid_velocity, {}}, q, grid, gradient)
          .external_work});
  momentum_to_grid(Shape::kind, q, q.velocity, grid);
  take(grid.all_nodes());
  gather_velocity_gradient(smoothed<Shape>(), q, grid, gradient);
  take(gradient);
  std::vector<Vector3> at_particles(q.size());
  gather_velocity(Shape::kind, q, grid, at_particles);
  take(at_particles);
  to_grid_and_advance();
  const TransferBalance balance = grid_to_particles(
      {smoothed<Shape>(), dt, CarriesAffineField<Shape> ? affine : AffineField::none, {}, {}}, q, grid,
      gradient);
  take(std::array{balance.work, balance.heat});
  take(gradient);
  take(q.position);
  take(q.velocity);
  take(q.affine_velocity);
  take(q.specific_internal_energy);
  if (nodes.size() > 0) {
    grid_to_nodes(smoothed<Shape>(), nodes, grid, dt, affine);
    take(nodes.velocity);
    take(nodes.affine_velocity);
    take(nodes.new_velocity);
    take(nodes.heat);
    for (std::size_t n = 0; n < nodes.unrelaxed; ++n) EXPECT_EQ(nodes.affine_velocity[n].norm(), 0.0) << n;
  }
  kernel_set() = in_use;
  return numbers;
}

TYPED_TEST(TransferKernels, WideRegistersGiveTheSameNumbers) {
  if (kernel_set() != KernelSet::wide)
    GTEST_SKIP() << "needs a processor with AVX-512, and an optimised build";
  const std::vector<double> of_wide = numbers_after_all_transfers<TypeParam>(KernelSet::wide);
  const std::vector<double> of_narrow = numbers_after_all_transfers<TypeParam>(KernelSet::narrow);
  ASSERT_EQ(of_wide.size(), of_narrow.size());
  std::size_t different = 0;  // a zero may have another sign
  for (std::size_t i = 0; i < of_wide.size(); ++i) different += of_wide[i] == of_narrow[i] ? 0 : 1;
  EXPECT_EQ(different, 0) << "of " << of_wide.size();
}

/// The numbers of one point are compared together: their differences in units of the largest of them.
TYPED_TEST(TransferKernels, PlainLoopsGiveTheSameNumbers) {
  for (const AffineField affine : {AffineField::deformed, AffineField::turned}) {
    const std::vector<double> fast = numbers_after_all_transfers<TypeParam>(KernelSet::narrow, affine);
    const std::vector<double> plain = numbers_after_all_transfers<TypeParam>(KernelSet::plain, affine);
    ASSERT_EQ(fast.size(), plain.size());
    for (std::size_t i = 0; i < fast.size(); ++i) {
      ASSERT_NEAR(plain[i], fast[i], 1e-13 * (10.0 + std::abs(fast[i]))) << i;
    }
  }
}

}  // namespace
}  // namespace whipple::transfer

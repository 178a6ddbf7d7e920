// SPDX-License-Identifier: BSD-3-Clause
// What the step of finite elements must not depend on: the frame of reference, the number of threads, the
// registers of the processor, the order of the elements.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "src/core/base/simd.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/particles/rows.hpp"
#include "tests/unit/fem_support.hpp"

namespace whipple::fem_test {
namespace {

/// The same motion in a turned, moving frame of another scale of time gives the turned result.
TEST(Invariance, TurnedAndMovingFrame) {
  const Matrix3 turn = Eigen::AngleAxisd(1.1, Vector3(0.3, -1.0, 0.7).normalized()).toRotationMatrix();
  const Vector3 drift(200.0, -300.0, 50.0);
  for (const Quadrature quadrature : both) {
    Body body = shaken(quadrature, stiffness, 0.25);
    Body turned = shaken(quadrature, stiffness, 0.25);
    for (std::size_t a = 0; a < body.mesh.nodes.size(); ++a) {
      turned.mesh.nodes.position[a] = turn * body.mesh.nodes.position[a];
      turned.mesh.nodes.velocity[a] = turn * body.mesh.nodes.velocity[a] + drift;
    }
    const double dt = 0.5 * body.critical_time_step();
    for (int i = 0; i < 100; ++i) {
      body.step(dt);
      turned.step(dt);
    }
    for (std::size_t a = 0; a < body.mesh.nodes.size(); ++a) {
      const Vector3 expected = turn * body.mesh.nodes.velocity[a] + drift;
      EXPECT_LT((turned.mesh.nodes.velocity[a] - expected).norm(), 1e-9 * 300.0) << name(quadrature);
    }
    EXPECT_NEAR(totals(turned.mesh).internal_energy, totals(body.mesh).internal_energy,
                1e-9 * totals(body.mesh).internal_energy);
  }
}

TEST(Invariance, BitwiseTheSameWithAnyNumberOfThreads) {
  for (const Quadrature quadrature : both) {
    std::vector<std::vector<Vector3>> results;
    for (const int threads : {1, 3}) {
      parallel::set_threads(threads);
      Body body = shaken(quadrature, stiffness, 0.25);
      for (int i = 0; i < 20; ++i) body.step(0.5 * body.critical_time_step());
      results.push_back(body.mesh.nodes.position);
    }
    parallel::set_threads(1);
    EXPECT_TRUE(results[0] == results[1]) << name(quadrature);
  }
}

/// Twenty steps with kernels for either set of registers; 27 elements fill three groups of eight and a part,
/// 729 are rows of four and five.
TEST(Invariance, WideRegistersGiveTheSameNumbers) {
  if (kernel_set() != KernelSet::wide) GTEST_SKIP() << "this processor has no AVX-512";
  const auto numbers_after_steps = [](Quadrature quadrature, const fem::HourglassControl& hourglass,
                                      const std::array<std::size_t, 3>& cells, bool wide) {
    kernel_set() = wide ? KernelSet::wide : KernelSet::narrow;
    Body body = shaken(quadrature, hourglass, 0.25, cells);
    const double dt = 0.3 * body.critical_time_step();
    for (int n = 0; n < 20; ++n) body.step(dt);
    std::vector<double> numbers = body.mesh.points.specific_internal_energy;
    numbers.insert(numbers.end(), body.mesh.points.length.begin(), body.mesh.points.length.end());
    numbers.insert(numbers.end(), {body.deformation.work, body.deformation.hourglass_work});
    const auto take = [&](const auto& values) {
      for (const auto& value : values) {
        const auto* from = reinterpret_cast<const double*>(&value);
        numbers.insert(numbers.end(), from, from + sizeof(value) / sizeof(double));
      }
    };
    take(body.mesh.nodes.position);
    take(body.mesh.nodes.force);
    for (const auto component : fem::Elements::hourglass_components()) take(body.mesh.elements.*component);
    for (const auto& component : body.gradients.component) take(component);
    kernel_set() = KernelSet::wide;
    return numbers;
  };
  for (const Quadrature quadrature : both) {
    for (const auto& hourglass : {stiffness, viscous}) {
      for (const auto& cells : box_cells) {
        const auto narrow = numbers_after_steps(quadrature, hourglass, cells, false),
                   wide = numbers_after_steps(quadrature, hourglass, cells, true);
        ASSERT_EQ(narrow.size(), wide.size());
        for (std::size_t i = 0; i < wide.size(); ++i) ASSERT_EQ(narrow[i], wide[i]) << name(quadrature) << i;
      }
    }
  }
}

/// The same elements in an order without rows, whatever the direction of the rows: only the sums at the nodes
/// are taken in another order.
TEST(Invariance, RowsOfElementsAreOnlyAnOrder) {
  for (const Quadrature quadrature : both) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& cells = box_cells[axis + 1];
      Body rows = shaken(quadrature, stiffness, 0.25, cells),
           mixed = shaken(quadrature, stiffness, 0.25, cells);
      const auto is_row = [](const fem::ElementGroup& group) { return group.is_row != 0; };
      const auto is_along = [&](const fem::ElementGroup& group) { return group.along == axis + 1; };
      EXPECT_GT(std::ranges::count_if(rows.mesh.blocks.groups, is_along),
                std::ssize(rows.mesh.blocks.groups) * 9 / 10);
      fem::Mesh& mesh = mixed.mesh;
      std::vector<std::uint32_t> order(mesh.elements.size());
      std::iota(order.begin(), order.end(), 0U);
      std::ranges::shuffle(order, std::mt19937_64(5));
      const auto n = static_cast<std::uint32_t>(fem::points_per_element(quadrature));
      std::vector<std::uint32_t> points;
      for (const std::uint32_t e : order) {
        for (std::uint32_t i = 0; i < n; ++i) points.push_back(n * e + i);
      }
      select_rows(mesh.elements, order);
      select_rows(mesh.points, points);
      fem::connect(mesh);
      EXPECT_TRUE(std::ranges::none_of(mesh.blocks.groups, is_row));
      const double dt = 0.4 * rows.critical_time_step();
      for (int i = 0; i < 20; ++i) {
        rows.step(dt);
        mixed.step(dt);
      }
      double difference = 0.0, moved = 0.0;
      for (std::size_t a = 0; a < rows.mesh.nodes.size(); ++a) {
        const Vector3& velocity = rows.mesh.nodes.velocity[a];
        difference = std::max(difference, (velocity - mixed.mesh.nodes.velocity[a]).norm());
        moved = std::max(moved, velocity.norm());
      }
      EXPECT_LT(difference, 1e-11 * moved) << name(quadrature);
    }
  }
}

/// The forces that `deform` leaves for the next step are those that a mesh which is put together again
/// computes from its positions and stresses, to the last bit: a restart changes nothing.
TEST(Invariance, ForcesOfTheStepAreThoseOfTheState) {
  for (const Quadrature quadrature : both) {
    for (const auto& cells : box_cells) {
      Body body = shaken(quadrature, stiffness, 0.25, cells);
      const double dt = 0.3 * body.critical_time_step();
      for (int n = 0; n < 5; ++n) body.step(dt);
      ASSERT_TRUE(body.mesh.blocks.forces_stand);
      fem::internal_forces(body.mesh);
      const std::vector<Vector3> of_step = body.mesh.nodes.force;
      fem::connect(body.mesh);
      ASSERT_FALSE(body.mesh.blocks.forces_stand);
      fem::internal_forces(body.mesh);
      EXPECT_EQ(of_step, body.mesh.nodes.force) << name(quadrature);
    }
  }
}

}  // namespace
}  // namespace whipple::fem_test

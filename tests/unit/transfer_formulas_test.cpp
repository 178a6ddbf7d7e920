// SPDX-License-Identifier: BSD-3-Clause
// Formulas of one point and its nodes against docs/theory/mpm.md, section 4, written out with matrices.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <random>

#include "src/core/base/tensor.hpp"
#include "src/transfer/formulas.hpp"

namespace whipple::transfer {
namespace {

Matrix3 random_matrix(std::mt19937& random, double scale) {
  std::uniform_real_distribution<double> uniform(-scale, scale);
  Matrix3 m;
  for (int i = 0; i < 9; ++i) m(i) = uniform(random);
  return m;
}

/// The heat of a point is (4.5) with its eight terms.
TEST(TransferFormulas, HeatIsThatOfTheTheory) {
  std::mt19937 random(7);
  constexpr double inertia = 0.3;
  constexpr std::array n = {0.1, 0.25, 0.3, 0.35};
  double heat = 0.0, expected = 0.0;
  Vector3 loss = Vector3::Zero(), change = loss, increment = loss, relaxed = loss;
  Matrix3 moment = Matrix3::Zero(), d_r = moment, relaxed_r = moment;
  for (const double weight : n) {
    const Matrix3 some = random_matrix(random, 1.0);
    const Vector3 difference = some.col(0), d = some.col(1), r = some.col(2);
    const double beta = 0.5 + 0.5 * r[0];
    for (int a = 0; a < 3; ++a) {
      const auto by_node = formulas::change_by_node(difference[a], d[a], beta);
      loss[a] += weight * by_node.loss;
      change[a] += weight * by_node.velocity;
      moment.row(a) += weight * by_node.velocity * r.transpose();
    }
    expected += weight * (0.5 * d.squaredNorm() + beta * difference.dot(difference - d));
    increment += weight * d;
    relaxed += weight * beta * difference;
    d_r += weight * d * r.transpose() / inertia;
    relaxed_r += weight * beta * difference * r.transpose() / inertia;
  }
  expected += -0.5 * increment.squaredNorm() + relaxed.dot(increment) - 0.5 * relaxed.squaredNorm();
  expected += inertia *
              (-0.5 * d_r.squaredNorm() + relaxed_r.cwiseProduct(d_r).sum() - 0.5 * relaxed_r.squaredNorm());
  for (int a = 0; a < 3; ++a) heat += formulas::heat_of_velocity(loss[a], change[a]);
  for (int i = 0; i < 9; ++i) {
    const auto gained = formulas::change_of_field(moment(i), 1.0 / inertia);
    heat -= gained.energy;
    EXPECT_NEAR(gained.field, d_r(i) - relaxed_r(i), 1e-15);
  }
  EXPECT_NEAR(heat, expected, 1e-14);
}

template <class Vector>
std::array<Vector, 3> columns_of(const Matrix3& m) {
  std::array<Vector, 3> columns;
  for (int a = 0; a < 3; ++a) {
    Vector& column = columns[static_cast<std::size_t>(a)];
    if constexpr (VectorRegister<Vector>) {
      column = Vector{m(0, a), m(1, a), m(2, a), 17.0};  // lane 3 is some number
    } else {
      column = {m(0, a), m(1, a), m(2, a)};
    }
  }
  return columns;
}
template <class Vector>
Matrix3 matrix_of(const std::array<Vector, 3>& columns) {
  Matrix3 m;
  for (int a = 0; a < 3; ++a) {
    const Vector& column = columns[static_cast<std::size_t>(a)];
    if constexpr (VectorRegister<Vector>) {
      m.col(a) << column[0], column[1], column[2];
    } else {
      m.col(a) << column.x, column.y, column.z;
    }
  }
  return m;
}
double first(double x) { return x; }
double first(Lanes x) { return x[0]; }

template <class Vector>
class ConvectedField : public testing::Test {};
using Vectors = testing::Types<Triple<double>, Lanes>;
TYPED_TEST_SUITE(ConvectedField, Vectors);

/// (4.8): C (I + dt L)^-1 scaled down where it would grow, with the loss of |C|^2; unchanged where the step turns a point
/// inside out.
TYPED_TEST(ConvectedField, IsThatOfTheTheory) {
  std::mt19937 random(11);
  constexpr double dt = 0.1;
  int grown = 0, shrunk = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const Matrix3 c = random_matrix(random, 3.0), l = random_matrix(random, 2.0);
    const Matrix3 carried = c * (Matrix3::Identity() + dt * l).inverse();
    const double k = std::min(1.0, c.norm() / carried.norm());
    (k < 1.0 ? grown : shrunk) += 1;
    auto columns = columns_of<TypeParam>(c);
    const double loss = first(formulas::convect(columns, columns_of<TypeParam>(l), dt));
    EXPECT_LT((matrix_of(columns) - k * carried).norm(), 1e-13);
    EXPECT_NEAR(loss, c.squaredNorm() - k * k * carried.squaredNorm(), 1e-12);
  }
  EXPECT_GT(grown, 5);
  EXPECT_GT(shrunk, 5);
  const Matrix3 c = random_matrix(random, 3.0), inverting = Vector3(-11.0, 1.0, 1.0).asDiagonal();
  auto columns = columns_of<TypeParam>(c);
  EXPECT_EQ(first(formulas::convect(columns, columns_of<TypeParam>(inverting), dt)), 0.0);
  EXPECT_EQ(matrix_of(columns), c);
}

}  // namespace
}  // namespace whipple::transfer

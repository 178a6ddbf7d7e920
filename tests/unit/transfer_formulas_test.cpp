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

double first(double x) { return x; }
double first(Lanes x) { return x[0]; }

template <class Number>
class FormulasOfAPoint : public testing::Test {};
using Numbers = testing::Types<double, Lanes>;
TYPED_TEST_SUITE(FormulasOfAPoint, Numbers);

/// Velocity and affine field change by (4.1) and (4.3), and the heat has the eight terms of (4.5).
TYPED_TEST(FormulasOfAPoint, AreThoseOfTheTheory) {
  const auto number = [](double x) {
    if constexpr (std::is_same_v<TypeParam, Lanes>)
      return Lanes{x, 1.0, 17.0, -3.0};
    else
      return x;
  };
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    const double inertia = 0.3 + uniform(random);
    std::array<double, 8> n;
    double sum = 0.0;
    for (double& weight : n) sum += weight = uniform(random);
    std::array<TypeParam, 3> loss{}, change{};
    std::array<std::array<TypeParam, 3>, 3> moment{};
    double expected = 0.0;
    Vector3 delta = Vector3::Zero(), b = delta;
    Matrix3 dc = Matrix3::Zero(), bc = dc;
    for (const double value : n) {
      const double weight = value / sum, beta = uniform(random);
      const Matrix3 some = random_matrix(random, 1.0);
      const Vector3 difference = some.col(0), d = some.col(1), r = some.col(2);
      for (std::size_t a = 0; a < 3; ++a) {
        const auto i = static_cast<Eigen::Index>(a);
        const auto by_node =
            formulas::change_by_node<TypeParam>(number(difference[i]), number(d[i]), number(beta));
        loss[a] += weight * by_node.loss;
        change[a] += weight * by_node.velocity;
        for (std::size_t c = 0; c < 3; ++c) {
          moment[a][c] += weight * r[static_cast<Eigen::Index>(c)] * by_node.velocity;
        }
      }
      delta += weight * d;
      b += weight * beta * difference;
      dc += weight * d * r.transpose() / inertia;
      bc += weight * beta * difference * r.transpose() / inertia;
      expected += weight * (0.5 * d.squaredNorm() + beta * difference.dot(difference - d));
    }
    expected += -0.5 * delta.squaredNorm() + b.dot(delta) - 0.5 * b.squaredNorm();
    expected += inertia * (-0.5 * dc.squaredNorm() + bc.cwiseProduct(dc).sum() - 0.5 * bc.squaredNorm());
    double heat = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto i = static_cast<Eigen::Index>(a);
      heat += first(formulas::heat_of_velocity<TypeParam>(loss[a], change[a]));
      EXPECT_NEAR(first(change[a]), delta[i] - b[i], 1e-15);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto j = static_cast<Eigen::Index>(c);
        const auto gained = formulas::change_of_field<TypeParam>(moment[a][c], number(1.0 / inertia));
        heat -= first(gained.energy);
        EXPECT_NEAR(first(gained.field), dc(i, j) - bc(i, j), 1e-14);
      }
    }
    EXPECT_NEAR(heat, expected, 1e-14);
  }
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

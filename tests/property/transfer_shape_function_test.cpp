// SPDX-License-Identifier: BSD-3-Clause
// Shape functions and the domains of particles by themselves: partition of unity, gradients, averages, second
// moments.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/shape_function.hpp"
#include "src/transfer/shape_weights.hpp"

namespace whipple::transfer {
namespace shape_function_test {

constexpr double dx = 0.5;

template <class Shape>
class ShapeFunctions : public testing::Test {};
using Shapes = testing::Types<Linear, Gimp, ConvectedGimp, QuadraticBSpline, CubicBSpline>;
TYPED_TEST_SUITE(ShapeFunctions, Shapes);

/// First node that a particle at x cells reaches.
template <class Shape>
double first_node(double x) {
  return std::floor(x - Shape::stencil.shift);
}

/// Weights of a particle at x cells whose domain has half-size h (cells), where it matters.
template <class Shape>
AxisWeights<Shape::count> weights_of(double x, [[maybe_unused]] double h) {
  if constexpr (Sized<Shape>) {
    return Shape::weights(x - first_node<Shape>(x), h * Shape::largest_half_size, dx);
  } else {
    return Shape::weights(x - first_node<Shape>(x), dx);
  }
}

TYPED_TEST(ShapeFunctions, ShapeFunctionsArePartitionsOfUnityWithConsistentGradients) {
  constexpr int count = TypeParam::count;
  for (double x = 0.001; x < 4.0; x += 0.0137) {
    const double h = 0.1 + 0.9 * (x / 4);  // share of the largest half-size of a sized function
    const AxisWeights<count> w = weights_of<TypeParam>(x, h);
    double sum = 0, slope = 0, first = 0, second = 0, linear = 0;
    for (std::size_t i = 0; i < count; ++i) {
      sum += w.weight[i];
      slope += w.derivative[i];
      first += w.weight[i] * w.distance[i];
      second += w.weight[i] * w.distance[i] * w.distance[i];
      linear += w.derivative[i] * w.distance[i];
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_NEAR(slope, 0.0, 1e-13);
    EXPECT_NEAR(first, 0.0, 1e-14);
    EXPECT_NEAR(linear, 1.0, 1e-13);  // gradient of a linear field is exact
    for (std::size_t i = 0; i < count; ++i) EXPECT_GE(w.weight[i], -1e-15);
    if constexpr (CarriesAffineField<TypeParam>) {  // what the affine transfer relies on
      EXPECT_NEAR(second, affine_inertia(TypeParam::kind, dx), 1e-14);
    }
    // Derivative by finite difference, away from the jumps of the linear functions.
    constexpr double step = 1e-6;
    const AxisWeights<count> w2 = weights_of<TypeParam>(x + step, h);
    if (first_node<TypeParam>(x + step) == first_node<TypeParam>(x)) {
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_NEAR((w2.weight[i] - w.weight[i]) / (step * dx), w.derivative[i], 1e-5 / h);
      }
    }
  }
}

// The slopes of quadratic functions (docs/theory/mpm.md, 2.8), whatever the smoothing.
TEST(SmoothSlopes, AreThoseOfLinearFieldsAndMeetFromCellToCell) {
  for (const double a1 : {0.0, 0.7, 1.5, 2.0}) {
    for (double g = 0.5; g <= 1.5; g += 0.0137) {
      const double y = g - 1.0, w = y + a1 * y * (0.25 - y * y);
      const auto at = QuadraticBSpline::weights(g, {dx, a1});
      EXPECT_NEAR(at.derivative[0], (w - 0.5) / dx, 1e-14);
      EXPECT_NEAR(at.derivative[1], -2.0 * w / dx, 1e-14);
      EXPECT_NEAR(at.derivative[2], (w + 0.5) / dx, 1e-14);
      double sum = 0.0, linear = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        sum += at.derivative[i];
        linear += at.derivative[i] * at.distance[i];
        const double inertia = QuadraticBSpline::second_moment * dx * dx;
        if (a1 == 2.0) {  // those of the affine field
          EXPECT_NEAR(at.derivative[i], at.weight[i] * at.distance[i] / inertia, 1e-13);
        }
      }
      EXPECT_NEAR(sum, 0.0, 1e-14);
      EXPECT_NEAR(linear, 1.0, 1e-14);
    }
    const auto end = QuadraticBSpline::weights(1.5, {dx, a1}),
               next = QuadraticBSpline::weights(0.5, {dx, a1});
    EXPECT_NEAR(end.derivative[0], 0.0, 1e-14);
    EXPECT_NEAR(end.derivative[1], next.derivative[0], 1e-14);
    EXPECT_NEAR(end.derivative[2], next.derivative[1], 1e-14);
    EXPECT_NEAR(next.derivative[2], 0.0, 1e-14);
  }
}

template <class Shape>
class SizedFunction : public testing::Test {};
using SizedShapes = testing::Types<Gimp, ConvectedGimp>;
TYPED_TEST_SUITE(SizedFunction, SizedShapes);

// The averages over the domains by quadrature of the linear functions.
TYPED_TEST(SizedFunction, IsTheAverageOfTheLinearOne) {
  for (const double h : {0.15, 0.5, 0.8}) {
    if (h > TypeParam::largest_half_size) continue;
    for (double x = 0.03; x < 4.0; x += 0.171) {
      const double first = first_node<TypeParam>(x);
      const auto w = TypeParam::weights(x - first, h, dx);
      constexpr int points = 2000;
      std::array<double, TypeParam::count> sum{};
      for (int q = 0; q < points; ++q) {
        const double at = x - h + 2 * h * (q + 0.5) / points;
        for (std::size_t i = 0; i < sum.size(); ++i) {
          sum[i] += std::max(0.0, 1 - std::abs(at - first - static_cast<double>(i))) / points;
        }
      }
      for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_NEAR(w.weight[i], sum[i], 1e-6);
    }
  }
}

// The box that stands for a domain does not change when the domain, a cube, is turned, and follows stretches
// along the axes exactly.
TEST(Domain, HalfSizesAreThoseOfTheSecondMoments) {
  const Matrix3 turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Matrix3 stretch = Vector3(1.5, 0.8, 1.0).asDiagonal();
  const double h = 0.25 * dx;
  const Matrix3 cube = h * h * Matrix3::Identity();
  EXPECT_LT(
      (half_sizes(SymmetricTensor::from(turn * cube * turn.transpose()), dx) - Vector3(.25, .25, .25)).norm(),
      1e-15);
  EXPECT_LT((half_sizes(SymmetricTensor::from(stretch * cube * stretch), dx) - Vector3(.375, .2, .25)).norm(),
            1e-15);
}

}  // namespace shape_function_test
}  // namespace whipple::transfer

// SPDX-License-Identifier: BSD-3-Clause
// One step of the transfers against plain loops over particles and nodes with the formulas of docs/theory/mpm.md,
// sections 2 to 4, and of textbooks for the shape functions.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "src/contact/grid_update.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/particles_to_grid.hpp"
#include "tests/property/transfer_support.hpp"

namespace whipple::transfer {
namespace {

constexpr double dt = 0.02, kappa = 0.7;

/// Shape function of one direction at a distance from its node (cells): value and slope (2.8).
struct OneDirection {
  double value = 0.0, slope = 0.0;
};
template <class Shape>
OneDirection textbook(double x) {
  const double s = std::abs(x), sign = x < 0.0 ? -1.0 : 1.0;
  if constexpr (std::is_same_v<Shape, Linear>) {
    return s < 1.0 ? OneDirection{1.0 - s, -sign} : OneDirection{};
  } else if constexpr (std::is_same_v<Shape, QuadraticBSpline>) {
    const auto w = [](double y) { return y + 1.3 * y * (0.25 - y * y); };  // the smoothing of `smoothed`
    if (s < 0.5) return {0.75 - s * s, -2.0 * w(x)};
    return s < 1.5 ? OneDirection{0.5 * (1.5 - s) * (1.5 - s), sign * (w(s - 1.0) - 0.5)} : OneDirection{};
  } else {
    if (s < 1.0) return {2.0 / 3.0 - s * s + 0.5 * s * s * s, -2.0 * x + 1.5 * sign * s * s};
    return s < 2.0 ? OneDirection{std::pow(2.0 - s, 3) / 6.0, -0.5 * sign * (2.0 - s) * (2.0 - s)}
                   : OneDirection{};
  }
}

struct ReferenceNode {
  double mass = 0.0, sound = 0.0, beta = 0.0;
  Vector3 momentum = Vector3::Zero(), force = Vector3::Zero(), v = Vector3::Zero(), d = Vector3::Zero();
};
using Nodes = std::map<std::array<int, 3>, ReferenceNode>;

/// Calls f(node, N, grad N, r) for the nodes of a place, r from the place to the node.
template <class Shape, class Function>
void for_each_node(const Vector3& position, Nodes& nodes, Function&& f) {
  const Vector3 x = (position - geometry().lower) / dx;
  std::array<int, 3> first;
  for (int a = 0; a < 3; ++a) first[static_cast<std::size_t>(a)] = static_cast<int>(std::floor(x[a])) - 2;
  for (int i = first[0]; i < first[0] + 6; ++i) {
    for (int j = first[1]; j < first[1] + 6; ++j) {
      for (int k = first[2]; k < first[2] + 6; ++k) {
        const std::array<OneDirection, 3> n = {textbook<Shape>(x[0] - i), textbook<Shape>(x[1] - j),
                                               textbook<Shape>(x[2] - k)};
        const double weight = n[0].value * n[1].value * n[2].value;
        if (weight == 0.0) continue;
        const Vector3 gradient =
            Vector3(n[0].slope * n[1].value * n[2].value, n[0].value * n[1].slope * n[2].value,
                    n[0].value * n[1].value * n[2].slope) /
            dx;
        f(nodes[{i, j, k}], weight, gradient, Vector3(dx * (Vector3(i, j, k) - x)));
      }
    }
  }
}

/// Returns R of (4.9) as the rotation about the axis of W by twice the angle whose tangent is half of its rate.
Matrix3 rotation_of_step(const Matrix3& gradient) {
  const Matrix3 spin = 0.5 * dt * (gradient - gradient.transpose());
  const Vector3 axis(spin(2, 1), spin(0, 2), spin(1, 0));
  return Eigen::AngleAxisd(2.0 * std::atan(0.5 * axis.norm()), axis.normalized()).toRotationMatrix();
}

template <class Shape>
void compare_step(AffineField field) {
  const bool affine = field != AffineField::none;
  constexpr double inertia =
      dx * dx * (std::is_same_v<Shape, QuadraticBSpline> ? 1.0 / 4.0 : 1.0 / 3.0);  // sum N r r^T
  Particles q = random_particles(400, Vector3(-1.2, -0.3, 4), Vector3(3, 2.5, 6.8), 11);
  if (!affine) std::ranges::fill(q.affine_velocity, Matrix3(Matrix3::Zero()));
  const Particles start = q;

  Nodes nodes;  // (3.1) to (3.3), (3.5)
  for (std::size_t p = 0; p < start.size(); ++p) {
    const Matrix3 stress = start.deviatoric_stress[p].matrix() -
                           (start.pressure[p] + start.artificial_viscosity[p]) * Matrix3::Identity();
    for_each_node<Shape>(start.position[p], nodes,
                         [&](ReferenceNode& node, double n, const Vector3& gradient, const Vector3& r) {
                           Vector3 v = start.velocity[p];
                           if (affine) v += start.affine_velocity[p] * r;
                           node.mass += n * start.mass[p];
                           node.momentum += n * start.mass[p] * v;
                           node.sound += n * start.mass[p] * start.sound_speed[p];
                           node.force -= start.volume[p] * stress * gradient;
                         });
  }
  for (auto& [place, node] : nodes) {
    node.v = node.momentum / node.mass;
    node.d = dt * node.force / node.mass;
    node.beta = 1.0 - std::exp(-kappa * node.sound / node.mass * dt / dx);
  }

  grid::BlockGrid grid(geometry(), parallel::world());
  bin<Shape>(grid, q);
  particles_to_grid(smoothed<Shape>(), q, grid);
  advance(grid, dt, {.kappa = kappa});
  std::vector<Matrix3> gradients(q.size());
  grid_to_particles({smoothed<Shape>(), dt, field, {}, {}}, q, grid, gradients);

  const auto near = [](double value, double reference, double scale) {
    return std::abs(value - reference) <= 1e-13 * (1.0 + scale + std::abs(reference));
  };
  for (std::size_t p = 0; p < start.size(); ++p) {
    const Matrix3 stress = start.deviatoric_stress[p].matrix() -
                           (start.pressure[p] + start.artificial_viscosity[p]) * Matrix3::Identity();
    Vector3 delta = Vector3::Zero(), b = delta, moved = delta;
    Matrix3 dc = Matrix3::Zero(), bc = dc, l = dc, l_mean = dc;
    double loss = 0.0, scale = 0.0;
    for_each_node<Shape>(start.position[p], nodes,
                         [&](ReferenceNode& node, double n, const Vector3& gradient, const Vector3& r) {
                           Vector3 difference = start.velocity[p] - node.v;
                           if (affine) difference += start.affine_velocity[p] * r;
                           delta += n * node.d;  // (4.1)
                           b += n * node.beta * difference;
                           dc += n * node.d * r.transpose() / inertia;
                           bc += n * node.beta * difference * r.transpose() / inertia;
                           moved += n * (node.v + node.d);
                           l += (node.v + node.d) * gradient.transpose();
                           l_mean += (node.v + 0.5 * node.d) * gradient.transpose();
                           loss += n * (0.5 * node.d.squaredNorm() +
                                        node.beta * difference.dot(difference - node.d));  // (4.5)
                           scale += n * (node.d.squaredNorm() + difference.squaredNorm()) +
                                    gradient.norm() * (node.d + node.v).norm();
                         });
    loss += -0.5 * delta.squaredNorm() + b.dot(delta) - 0.5 * b.squaredNorm();
    const Vector3 velocity = start.velocity[p] + delta - b;  // (4.3)
    Matrix3 c = start.affine_velocity[p];
    if (affine) {
      loss += inertia * (-0.5 * dc.squaredNorm() + bc.cwiseProduct(dc).sum() - 0.5 * bc.squaredNorm());
      c += dc - bc;
      const Matrix3 step = Matrix3::Identity() + dt * l;
      if (field == AffineField::turned) {
        c *= rotation_of_step(l).transpose();
      } else if (step.determinant() > 0.1) {  // (4.8)
        const Matrix3 carried = c * step.inverse();
        const double cap = std::min(1.0, c.norm() / carried.norm());
        loss += 0.5 * inertia * (c.squaredNorm() - (cap * carried).squaredNorm());
        c = cap * carried;
      }
    }
    const double work = start.volume[p] * stress.cwiseProduct(l_mean).sum() * dt / start.mass[p];  // (4.6)
    const double energy = start.specific_internal_energy[p] + work + loss;
    EXPECT_TRUE(near(q.specific_internal_energy[p], energy, scale))
        << p << " " << q.specific_internal_energy[p] - energy;
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(near(q.position[p][i], start.position[p][i] + dt * moved[i], scale)) << p;
      EXPECT_TRUE(near(q.velocity[p][i], velocity[i], scale)) << p << " " << q.velocity[p][i] - velocity[i];
      for (int j = 0; j < 3; ++j) {
        EXPECT_TRUE(near(gradients[p](i, j), l(i, j), scale)) << p << " " << gradients[p](i, j) - l(i, j);
        if (!affine) continue;
        EXPECT_TRUE(near(q.affine_velocity[p](i, j), c(i, j), scale))
            << p << " " << q.affine_velocity[p](i, j) - c(i, j);
      }
    }
  }
}

template <class Shape>
class TransferReference : public testing::Test {};
using TextbookShapes = testing::Types<Linear, QuadraticBSpline, CubicBSpline>;
TYPED_TEST_SUITE(TransferReference, TextbookShapes);

TYPED_TEST(TransferReference, PlainLoopsGiveTheSameStep) {
  using enum AffineField;
  compare_step<TypeParam>(none);
  if constexpr (CarriesAffineField<TypeParam>) {
    compare_step<TypeParam>(deformed);
    compare_step<TypeParam>(turned);
  }
}

}  // namespace
}  // namespace whipple::transfer

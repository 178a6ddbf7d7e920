// SPDX-License-Identifier: BSD-3-Clause
// Fields under compression at a node (docs/theory/contact.md, section 4): for any masses, velocities, forces, normals
// and gaps momentum and energy are exact, no heat is negative, no pair is in tension.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "src/contact/half_thickness.hpp"
#include "src/contact/pressing.hpp"
#include "src/contact/surface_points.hpp"

namespace whipple::contact {
namespace {

struct Meeting {
  std::size_t a, b;
  Vector3 normal;
  double open;  // m
};

constexpr double dt = 1e-8;  // s

/// Holds fields at a node before and after contact.
struct Trial {
  std::vector<grid::Node> before, after;
  std::vector<double> mass;
  std::vector<Meeting> meetings;
  Balance balance;
  double heat = 0.0;  ///< J, on the nodes

  void apply(double friction) {
    after = before;
    std::vector<Side> sides;
    for (std::size_t s = 0; s < after.size(); ++s) {
      sides.push_back({.node = &after[s], .mass = mass[s]});
      after[s].motion.set_heat(0.0);
    }
    Pressing pressing;
    pressing.begin(sides);
    for (const Meeting& m : meetings) {
      const double share = Pressing::share(sides[m.a], sides[m.b], m.normal, m.open, dt);
      if (share > 0.0) pressing.add(m.a, m.b, m.normal, share, friction);
    }
    balance = {};
    pressing.apply(balance);
    heat = 0.0;
    for (const Side& side : sides) heat += side.heat;
  }

  /// Returns the impulse (N s) of the node on the particles of a field, without that of their own forces: they
  /// contribute m u and receive m (d - beta (u - v)), equation (4.3) of mpm.md.
  [[nodiscard]] Vector3 impulse(std::size_t s) const {
    const Vector3 u = before[s].motion.velocity(), v = after[s].motion.velocity();
    const Vector3 f = before[s].motion.increment(), d = after[s].motion.increment();
    return mass[s] * (d - f - after[s].motion.relaxation() * (u - v));
  }
  /// Returns the change of the energy (J) of the particles of a field, with the heat of their transfer and the work of
  /// their stresses, (4.5) and (4.6) of mpm.md, summed over them.
  [[nodiscard]] double energy(std::size_t s) const {
    const Vector3 u = before[s].motion.velocity(), v = after[s].motion.velocity();
    const Vector3 f = before[s].motion.increment(), d = after[s].motion.increment();
    const double beta = after[s].motion.relaxation();
    const double kinetic =
        v.dot(d) + 0.5 * d.squaredNorm() + (1.0 - beta) * (u - v).dot(d) - beta * v.dot(u - v);
    return mass[s] * (kinetic - f.dot(v + 0.5 * d));
  }
  [[nodiscard]] double scale() const {
    double sum = 0.0;
    for (std::size_t s = 0; s < mass.size(); ++s) {
      sum +=
          mass[s] * (before[s].motion.velocity().squaredNorm() + before[s].motion.increment().squaredNorm());
    }
    return sum;
  }
};

class Pressed : public ::testing::TestWithParam<int> {
 protected:
  std::mt19937 random{7};
  double uniform(double lower, double upper) { return std::uniform_real_distribution(lower, upper)(random); }
  Vector3 direction() {
    Vector3 n;
    do {
      n = Vector3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    } while (n.squaredNorm() > 1.0 || n.squaredNorm() < 0.01);
    return n.normalized();
  }
  /// @param parallel  all normals along one line, as in the layers of a stack
  Trial trial(int fields, bool parallel) {
    Trial t;
    const Vector3 axis = direction();
    for (int s = 0; s < fields; ++s) {
      t.mass.push_back(std::pow(10.0, uniform(-12, -3)));
      const Vector3 v =
          300.0 * Vector3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) + Vector3(900, 0, -200);
      const Vector3 d = 300.0 * Vector3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      t.before.push_back({Lanes{v[0], v[1], v[2], uniform(0.01, 1.0)}, Lanes{d[0], d[1], d[2], 0.0}});
    }
    for (std::size_t a = 0; a < t.mass.size(); ++a) {
      for (std::size_t b = a + 1; b < t.mass.size(); ++b) {
        const double open = uniform(0, 1) < 0.5 ? 0.0 : uniform(0.0, 6e-6);
        t.meetings.push_back({a, b, parallel ? axis : direction(), open});
      }
    }
    return t;
  }
};

TEST_P(Pressed, KeepMomentumAndEnergyAndMakeHeat) {
  int acted = 0;
  for (int n = 0; n < 3000; ++n) {
    Trial t = trial(GetParam(), n % 2 == 0);
    const double friction = n % 3 == 0 ? 0.0 : n % 3 == 1 ? 0.3 : 1e6;
    t.apply(friction);
    Vector3 sum = Vector3::Zero();
    double energy = t.heat, largest = 0.0;
    for (std::size_t s = 0; s < t.mass.size(); ++s) {
      sum += t.impulse(s);
      largest = std::max(largest, t.mass[s]);
      energy += t.energy(s);
    }
    const double scale = t.scale();
    EXPECT_LT(sum.norm(), 1e-12 * largest * std::sqrt(scale / largest)) << n;
    EXPECT_LT(std::abs(energy), 1e-12 * scale) << n;
    EXPECT_GE(t.balance.contact_heat, -1e-12 * scale) << n;
    EXPECT_GE(t.balance.friction_heat, -1e-15 * scale) << n;
    EXPECT_NEAR(t.heat, t.balance.contact_heat + t.balance.friction_heat, 1e-14 * scale) << n;
    EXPECT_GE(t.balance.impulse, 0.0) << n;
    EXPECT_LE(t.balance.friction_impulse, (1 + 1e-12) * friction * t.balance.impulse) << n;
    acted += t.balance.impulse > 0.0 ? 1 : 0;
  }
  EXPECT_GT(acted, 1000);
}

INSTANTIATE_TEST_SUITE_P(Fields, Pressed, ::testing::Values(2, 3, 4, 6));

TEST_F(Pressed, TwoThatTouchMoveAsOneAlongTheNormal) {
  for (int n = 0; n < 200; ++n) {
    Trial t = trial(2, false);
    t.meetings[0].open = 0.0;
    t.apply(0.0);
    const Vector3 normal = t.meetings[0].normal;
    if (t.balance.impulse == 0.0) {
      for (std::size_t s = 0; s < 2; ++s) {
        for (int c = 0; c < 4; ++c)
          EXPECT_EQ(t.after[s].motion.velocity_and_relaxation[c],
                    t.before[s].motion.velocity_and_relaxation[c]);
      }
      continue;
    }
    EXPECT_NEAR(normal.dot(t.after[1].motion.velocity() - t.after[0].motion.velocity()), 0.0, 1e-9);
    EXPECT_NEAR(normal.dot(t.after[1].motion.increment() - t.after[0].motion.increment()), 0.0, 1e-9);
    EXPECT_EQ(t.after[0].motion.relaxation(), t.after[1].motion.relaxation());
    EXPECT_NEAR(t.balance.contact_heat, 0.0, 1e-20);
    EXPECT_GT(normal.dot(t.impulse(1)), 0.0);
  }
}

// Surfaces that close their gap within the step touch exactly at its end.
TEST_F(Pressed, AGapClosesExactly) {
  int closed = 0;
  for (int n = 0; n < 500; ++n) {
    Trial t = trial(2, false);
    const Vector3 normal = t.meetings[0].normal;
    const auto closing = [&](const std::vector<grid::Node>& nodes) {
      return -normal.dot(nodes[1].motion.velocity() + nodes[1].motion.increment() -
                         nodes[0].motion.velocity() - nodes[0].motion.increment()) *
             dt;
    };
    t.meetings[0].open = uniform(0.0, 1e-5);
    t.apply(0.0);
    if (t.balance.impulse > 0.0) {
      ++closed;
      EXPECT_NEAR(closing(t.after), t.meetings[0].open, 1e-17);
    } else {
      for (std::size_t s = 0; s < 2; ++s) {
        for (int c = 0; c < 4; ++c)
          EXPECT_EQ(t.after[s].motion.velocity_and_relaxation[c],
                    t.before[s].motion.velocity_and_relaxation[c]);
      }
    }
    if (closing(t.before) < t.meetings[0].open) {
      EXPECT_EQ(t.balance.impulse, 0.0);
    }
  }
  EXPECT_GT(closed, 50);
}

// A pair that is under compression only because of a third body is included; a pair in tension is not.
TEST_F(Pressed, AStackMovesAsOneAndDoesNotPull) {
  Trial t;
  t.mass = {1e-6, 2e-6, 3e-6};
  const auto node = [](double v) { return grid::Node{{Lanes{v, 0, 0, 0.1}, Lanes{0, 0, 0, 0}}}; };
  t.before = {node(0), node(0), node(-60)};
  t.meetings = {{0, 1, Vector3::UnitX(), 0.0}, {1, 2, Vector3::UnitX(), 0.0}, {0, 2, Vector3::UnitX(), 0.0}};
  t.apply(0.0);
  for (std::size_t s = 0; s < 3; ++s) EXPECT_NEAR(t.after[s].motion.velocity_and_relaxation[0], -30.0, 1e-6);
  // The first moves away, but more slowly than the common velocity
  t.before = {node(-5), node(0), node(-60)};
  t.apply(0.0);
  EXPECT_NEAR(t.after[0].motion.velocity_and_relaxation[0], -185.0 / 6.0, 1e-6);
  t.before = {node(-90), node(0), node(-60)};  // faster
  t.apply(0.0);
  EXPECT_EQ(t.after[0].motion.velocity_and_relaxation[0], -90.0);
  EXPECT_NEAR(t.after[1].motion.velocity_and_relaxation[0], -36.0, 1e-6);
  EXPECT_NEAR(t.after[2].motion.velocity_and_relaxation[0], -36.0, 1e-6);
}

// Eq. 3.6: the points of a facet represent its area vector whatever its shape; for a parallelogram also its area and
// its first moment. The vectors of a closed surface cancel.
TEST(SurfacePoints, HoldTheAreaVectorsOfTheFacets) {
  const std::vector<fem::Facet> facets = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                          {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  const Vector3 a(2.0, 0.1, 0.3), b(-0.4, 1.5, 0.2), c(0.1, -0.3, 1.0);
  for (const double warped : {0.0, 0.3}) {
    fem::Mesh mesh;
    mesh.nodes.position = {Vector3::Zero(), a, a + b, b, c, a + c, Vector3(a + b + c), b + c};
    mesh.nodes.position[6] += warped * Vector3(1.0, 0.5, -0.7);
    mesh.nodes.mass.assign(8, 1.0);
    for (std::uint64_t id = 0; id < 8; ++id) mesh.nodes.id.push_back(id);
    SurfacePoints all;
    all.add(mesh, facets, 1, 0.35, nullptr);
    EXPECT_NEAR(std::accumulate(all.area.begin(), all.area.end(), Vector3(Vector3::Zero())).norm(), 0.0,
                1e-14);
    for (const fem::Facet& facet : facets) {
      SCOPED_TRACE(facet[0]);
      std::array<Vector3, 4> x;
      for (std::size_t i = 0; i < 4; ++i) x[i] = mesh.nodes.position[facet[i]];
      SurfacePoints points;
      points.add(mesh, std::span(&facet, 1), 1, 0.35, nullptr);
      Vector3 area = Vector3::Zero(), moment = Vector3::Zero();
      double size = 0.0;
      for (std::size_t p = 0; p < points.count(); ++p) {
        area += points.area[p];
        moment += points.size[p] * points.position[p];
        size += points.size[p];
      }
      const Vector3 exact = 0.5 * (x[2] - x[0]).cross(x[3] - x[1]);
      EXPECT_NEAR((area - exact).norm(), 0.0, 1e-14);
      EXPECT_EQ(std::ranges::count(points.node, SurfacePoints::no_node),
                static_cast<long>(points.count()) - 4);
      if (warped > 0.0) continue;
      EXPECT_NEAR(size, exact.norm(), 1e-14);
      EXPECT_NEAR((moment / size - 0.25 * (x[0] + x[1] + x[2] + x[3])).norm(), 0.0, 1e-14);
    }
  }
}

// Mirror planes take the thickness along the axes, contact along any normal: they are one.
TEST(HalfThicknessOfParticles, AlongTheAxesIsThatAlongTheirUnitVectors) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Particles particles;
  particles.position.resize(30);
  particles.volume.resize(30);
  particles.void_volume.resize(30);
  particles.extent.resize(30);
  for (std::size_t p = 0; p < 30; ++p) {
    particles.position[p] = Vector3(1.0, 2.0 + number(random), 0.0);
    particles.volume[p] = 1e-9 * (1.5 + number(random));
    particles.void_volume[p] = p % 3 == 0 ? 1e-10 : 0.0;
    const Matrix3 edge = Matrix3::NullaryExpr([&] { return 1e-3 * number(random); });
    particles.extent[p] = p % 5 == 0 ? SymmetricTensor{} : SymmetricTensor::from(edge * edge.transpose());
  }
  for (const grid::Dimension dimension :
       {grid::Dimension::space, grid::Dimension::plane_strain, grid::Dimension::axisymmetric}) {
    grid::Geometry geometry;
    geometry.dimension = dimension;
    for (std::size_t p = 0; p < 30; ++p) {
      const HalfThickness half(geometry, particles, p);
      const Lanes along = half.along_axes();
      for (int a = 0; a < (geometry.is_planar() ? 2 : 3); ++a) {
        EXPECT_NEAR(along[a], half.along(Vector3::Unit(a)), 1e-15 * half.largest());
        EXPECT_GT(along[a], 0.0);
      }
    }
  }
}

}  // namespace
}  // namespace whipple::contact

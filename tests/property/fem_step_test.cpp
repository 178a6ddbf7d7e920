// SPDX-License-Identifier: BSD-3-Clause
// Laws that hold for every mesh and every state: volume and its derivative, patch test, conservation,
// rigid rotation, hourglass modes, bound of the time step.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <numbers>

#include "src/fem/element_kernels/element_registers.hpp"
#include "src/fem/hexahedron.hpp"
#include "src/fem/quadrilateral.hpp"
#include "tests/unit/fem_support.hpp"

namespace whipple::fem_test {
namespace {

TEST(FourVectors, TakeOneNumberEachBesideTheirComponents) {
  const std::array<Lanes, 3> beside = fem::beside_components(Lanes{0.0, 1.0, 2.0, 3.0});
  std::array<double, 12> stored;
  fem::store_vectors(stored.data(),
                     {Lanes{0.0, 1.0, 2.0, 3.0}, Lanes{0.0, 1.0, 2.0, 3.0}, Lanes{0.0, 1.0, 2.0, 3.0}});
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(beside[i / 4][i % 4], static_cast<double>(i / 3)) << i;
    EXPECT_EQ(stored[i], static_cast<double>(i / 3)) << i;
  }
}

std::array<Triple<double>, 8> random_hexahedron(std::mt19937_64& generator, double distortion) {
  std::uniform_real_distribution<double> uniform(-distortion, distortion);
  std::array<Triple<double>, 8> x;
  for (std::size_t a = 0; a < 8; ++a) {
    const auto& at = fem::corner_coordinates[a];
    x[a] = {at[0] + uniform(generator), at[1] + uniform(generator), at[2] + uniform(generator)};
  }
  return x;
}

TEST(Hexahedron, ModesAreExactlyTheCorners) {
  std::mt19937_64 generator(1);
  const auto x = random_hexahedron(generator, 0.5);
  const auto back = fem::corners_of(fem::modes_of(x));
  Triple<double> mean{};
  for (const auto& corner : x) mean += 0.125 * corner;
  for (std::size_t a = 0; a < 8; ++a) {
    EXPECT_NEAR(back[a].x + mean.x, x[a].x, 1e-15);
    EXPECT_NEAR(back[a].y + mean.y, x[a].y, 1e-15);
    EXPECT_NEAR(back[a].z + mean.z, x[a].z, 1e-15);
  }
}

TEST(Hexahedron, VolumeIsThatOfEightGaussPoints) {  // which integrate the trilinear map exactly
  std::mt19937_64 generator(2);
  for (int trial = 0; trial < 20; ++trial) {
    const auto x = fem::modes_of(random_hexahedron(generator, 0.4));
    double sum = 0.0;
    for (const auto& at : fem::corner_coordinates) {
      const double g = fem::gauss_coordinate;
      sum += determinant(fem::natural_gradient(x, g * at[0], g * at[1], g * at[2]));
    }
    EXPECT_NEAR(fem::volume_of(x), sum, 1e-13);
    EXPECT_NEAR(fem::volume_gradient(x).volume, sum, 1e-13);
  }
}

TEST(Hexahedron, GradientOfTheVolumeByDifferences) {
  std::mt19937_64 generator(3);
  const auto x = random_hexahedron(generator, 0.4);
  const auto g = fem::volume_gradient(fem::modes_of(x));
  const auto corners =
      fem::corners_of(fem::Modes<double>{g.xi, g.eta, g.zeta, g.eta_zeta, g.zeta_xi, g.xi_eta, {}});
  double squares = 0.0;
  for (std::size_t a = 0; a < 8; ++a) {
    for (double Triple<double>::* c : {&Triple<double>::x, &Triple<double>::y, &Triple<double>::z}) {
      auto ahead = x, behind = x;  // the volume is linear in each coordinate: differences are exact
      ahead[a].*c += 0.5;
      behind[a].*c -= 0.5;
      const double difference = fem::volume_of(fem::modes_of(ahead)) - fem::volume_of(fem::modes_of(behind));
      EXPECT_NEAR(corners[a].*c, difference, 1e-13);
      squares += corners[a].*c * (corners[a].*c);
    }
  }
  EXPECT_NEAR(g.squared_norm(), squares, 1e-12);
}

TEST(Hexahedron, LengthOfACubeIsItsEdge) {
  std::array<Triple<double>, 8> x;
  for (std::size_t a = 0; a < 8; ++a) {
    const auto& at = fem::corner_coordinates[a];
    x[a] = {1.5 * at[0], 1.5 * at[1], 1.5 * at[2]};
  }
  const auto modes = fem::modes_of(x);
  const auto g = fem::volume_gradient(modes);
  EXPECT_NEAR((fem::length_of<fem::Quadrature::one_point>(g, 0.0)), 3.0, 1e-14);
  EXPECT_NEAR(fem::eight_point_size(modes, g).length, 3.0, 1e-14);
}

/// Patch test, kinematic half: a linear velocity field gives every Gauss point of a distorted mesh its
/// gradient.
TEST(Patch, LinearVelocityGivesItsGradient) {
  for (const Quadrature quadrature : both) {
    Body body(Solid{}.material(), distorted_box(4, 1.0, 0.25), quadrature);
    std::mt19937_64 generator(5);
    const Matrix3 gradient = material_test::random_matrix(generator, 10.0);
    body.motion.mean.resize(body.mesh.nodes.size());
    for (std::size_t a = 0; a < body.mesh.nodes.size(); ++a)
      body.motion.mean[a] = gradient * body.mesh.nodes.position[a];
    body.motion.end = body.motion.mean;
    fem::deform(body.mesh, body.motion, 1e-3, body.hourglass, body.gradients);
    for (std::size_t i = 0; i < body.gradients.size(); ++i)
      EXPECT_LT((body.gradients.at(i) - gradient).norm(), 1e-12 * gradient.norm()) << name(quadrature);
    for (std::size_t e = 0; e < body.mesh.elements.size();
         ++e) {  // no linear field moves the hourglass modes
      const double q = hourglass_force(body.mesh.elements, e).norm();
      EXPECT_LT(q, 1e-13 * 0.05 * 111e9 * 1e-2) << name(quadrature);
    }
  }
}

/// Patch test, static half: a uniform stress leaves no force on inner nodes and its traction on the surface.
TEST(Patch, UniformStressIsInEquilibrium) {
  for (const Quadrature quadrature : both) {
    Body body(Solid{}.material(), distorted_box(4, 1.0, 0.25), quadrature);
    auto& points = body.mesh.points;
    std::ranges::fill(points.deviatoric_stress, SymmetricTensor{3e6, -1e6, -2e6, 5e6, -4e6, 2e6});
    std::ranges::fill(points.pressure, 7e6);
    std::ranges::fill(points.artificial_viscosity, 1e6);
    fem::internal_forces(body.mesh);
    Vector3 sum = Vector3::Zero();
    Matrix3 moment = Matrix3::Zero();
    int inner = 0;
    double volume = 0.0;
    for (std::size_t a = 0; a < body.mesh.nodes.size(); ++a) {
      const Vector3& f = body.mesh.nodes.force[a];
      sum += f;
      moment += f * body.mesh.nodes.position[a].transpose();
      if (body.mesh.corners_at(a).size() < 8) continue;
      ++inner;
      EXPECT_LT(f.norm(), 1e-8) << name(quadrature);  // of 1e7 Pa m^2
    }
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) volume += fem::volume(body.mesh, e);
    Matrix3 stress = points.deviatoric_stress[0].matrix() - 8e6 * Matrix3::Identity();
    EXPECT_EQ(inner, 27);
    EXPECT_LT(sum.norm(), 1e-7) << name(quadrature);
    EXPECT_LT((moment + volume * stress).norm(), 1e-7 * volume) << name(quadrature);  // sum f x^T = -V sigma
  }
}

/// Kinetic, internal and hourglass energy together, momentum and angular momentum about the origin: to
/// round-off, whatever the quadrature, the hourglass control and the viscosity.
TEST(Conservation, EnergyMomentumAngularMomentum) {
  for (const Quadrature quadrature : both) {
    for (const auto& control : {no_control, stiffness, viscous}) {
      for (const double viscosity : {0.0, 0.25}) {
        Body body = shaken(quadrature, control, viscosity);
        const fem::MeshTotals before = totals(body.mesh);
        const Vector3 turning = angular_momentum(body.mesh);
        const double start = body.critical_time_step();
        for (int i = 0; i < 200; ++i) body.step(0.5 * start);
        const fem::MeshTotals now = totals(body.mesh);
        ASSERT_TRUE(body.report.valid());
        EXPECT_GT(now.internal_energy, 1e-4 * before.kinetic_energy);
        EXPECT_NEAR(now.energy(), before.energy(), 1e-13 * before.energy()) << name(quadrature);
        EXPECT_LT((now.momentum - before.momentum).norm(), 1e-13 * before.momentum_scale);
        const double arm = 4e-3 * before.momentum_scale;
        EXPECT_LT((angular_momentum(body.mesh) - turning).norm(), 1e-12 * arm) << name(quadrature);
      }
    }
  }
}

/// The Gauss points have the density of their element at every time, however it was deformed.
TEST(Conservation, VolumeOfThePointsIsThatOfTheElement) {
  for (const Quadrature quadrature : both) {
    Body body = shaken(quadrature, stiffness);
    for (int i = 0; i < 200; ++i) body.step(0.5 * body.critical_time_step());
    const std::size_t n = points_per_element(quadrature);
    double greatest_change = 0.0;
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
      double volume = 0.0;
      for (std::size_t q = 0; q < n; ++q) volume += body.mesh.points.volume[n * e + q];
      EXPECT_NEAR(volume, fem::volume(body.mesh, e), 1e-12 * volume);
      greatest_change = std::max(greatest_change, std::abs(volume * 2700.0 / fem::mass(body.mesh, e) - 1.0));
    }
    EXPECT_GT(greatest_change, 1e-4);
  }
}

/// A rigid rotation, in steps of 6 degrees, of a distorted mesh: no stress, no heat, no hourglass force;
/// forces of hourglass modes that are there turn with the body.
TEST(RigidRotation, NoStressAndHourglassForcesTurn) {
  for (const Quadrature quadrature : both) {
    Body body(Solid{}.material(), distorted_box(3, 1.0, 0.2), quadrature);
    const Vector3 axis = Vector3(1.0, -2.0, 0.5).normalized();
    const Matrix3 turn = Eigen::AngleAxisd(std::numbers::pi / 30.0, axis).toRotationMatrix();
    const double dt = 1e-6;
    HourglassForce q;
    q << 1, 2, 3, 4, -5, 6, -7, 8, 9, -10, 11, 12;
    if (quadrature == Quadrature::one_point) {
      set_hourglass_force(body.mesh.elements, 5, q);
      body.mesh.elements.hourglass_energy[5] = 1.0;  // far more than these forces need
    }
    const auto start = body.mesh.nodes.position;
    body.motion.mean.assign(body.mesh.nodes.size(), Vector3::Zero());
    body.motion.end.resize(body.mesh.nodes.size());
    UpdateSettings settings;
    settings.time_step = dt;
    settings.lengths = body.mesh.points.length;
    for (int i = 0; i < 25; ++i) {
      for (std::size_t a = 0; a < body.mesh.nodes.size(); ++a) {
        body.motion.end[a] = (turn * body.mesh.nodes.position[a] - body.mesh.nodes.position[a]) / dt;
      }
      fem::deform(body.mesh, body.motion, dt, stiffness, body.gradients);
      fem::move_nodes(body.mesh, body.motion, dt);
      update_material(body.material, body.mesh.points, 0, body.mesh.points.size(), body.gradients.from(0),
                      settings);
    }
    Matrix3 whole = Matrix3::Identity();
    for (int i = 0; i < 25; ++i) whole = turn * whole;
    for (std::size_t a = 0; a < start.size(); ++a) {
      EXPECT_LT((body.mesh.nodes.position[a] - whole * start[a]).norm(), 1e-13);
    }
    for (std::size_t i = 0; i < body.mesh.points.size(); ++i) {
      EXPECT_LT(std::sqrt(body.mesh.points.deviatoric_stress[i].squared_norm()), 1e-12 * 27e9);
      EXPECT_LT(std::abs(body.mesh.points.pressure[i]), 1e-11 * 75e9);
    }
    if (quadrature == Quadrature::b_bar) continue;
    // K dt of an element is some 1e10 N/m: round-off of its velocities leaves 1e-4 N.
    EXPECT_LT(hourglass_force(body.mesh.elements, 4).norm(), 1e-3);
    EXPECT_LT((hourglass_force(body.mesh.elements, 5) - whole * q).norm(), 1e-3);
  }
}

/// Velocities of one of the four hourglass modes of a cube.
Body hourglassing(fem::HourglassControl control, std::size_t mode, double speed = 1.0) {
  Body body(Solid{}.material(),
            fem::make_box(Vector3::Constant(-0.5e-3), Vector3::Constant(0.5e-3), {1, 1, 1}),
            Quadrature::one_point);
  body.hourglass = control;
  body.set_velocity([&](const Vector3& x) {
    const Vector3 s = x.cwiseSign();
    const std::array<double, 4> pattern = {s[1] * s[2], s[2] * s[0], s[0] * s[1], s[0] * s[1] * s[2]};
    return Vector3(speed * pattern[mode], 0.0, 0.0);
  });
  return body;
}

TEST(Hourglass, ModesHaveNoEnergyWithoutControl) {
  for (std::size_t mode = 0; mode < 4; ++mode) {
    Body body = hourglassing(no_control, mode);
    const fem::MeshTotals before = totals(body.mesh);
    const double dt = 0.5 * body.critical_time_step();
    for (int i = 0; i < 20; ++i) body.step(dt);
    EXPECT_NEAR(totals(body.mesh).kinetic_energy, before.kinetic_energy, 1e-14 * before.kinetic_energy);
    EXPECT_LT(std::abs(totals(body.mesh).internal_energy), 1e-14 * before.kinetic_energy);
    // Nothing holds the node: it moves at its first speed.
    EXPECT_NEAR(body.mesh.nodes.position[0].x() + 0.5e-3, body.time * body.mesh.nodes.velocity[0].x(), 1e-15);
  }
}

/// The stiffness lets a mode oscillate with its frequency sqrt(kappa) times the bound of the element; the
/// viscosity takes it away at the rate of its share of critical damping. Energy closes.
TEST(Hourglass, ControlHoldsTheModes) {
  for (std::size_t mode = 0; mode < 4; ++mode) {
    Body stiff = hourglassing(stiffness, mode, 1e-3);
    const double bound = 2.0 / stiff.critical_time_step(), kinetic = totals(stiff.mesh).kinetic_energy;
    const double frequency = bound * std::sqrt(stiffness.coefficient), dt = 1e-3 / frequency;
    const double start = stiff.mesh.nodes.position[0].x();
    double greatest = 0.0, when = 0.0;
    for (int i = 0; i < 2000; ++i) {
      stiff.step(dt);
      const double moved = std::abs(stiff.mesh.nodes.position[0].x() - start);
      if (moved > greatest) greatest = moved, when = stiff.time;
    }
    EXPECT_NEAR(when * frequency, 0.5 * std::numbers::pi, 2e-3);
    EXPECT_NEAR(greatest, 1e-3 / frequency, 2e-3 * 1e-3 / frequency);
    EXPECT_NEAR(totals(stiff.mesh).energy(), kinetic, 1e-13 * kinetic);
    EXPECT_GT(totals(stiff.mesh).hourglass_energy, 0.1 * kinetic);

    Body damped = hourglassing(viscous, mode, 1e-3);
    const double rate = 2.0 * viscous.coefficient * bound;  // of the velocity
    for (int i = 0; i < 1000; ++i) damped.step(1e-3 / rate);
    EXPECT_NEAR(totals(damped.mesh).kinetic_energy / kinetic, std::exp(-2.0), 5e-3 * std::exp(-2.0));
    EXPECT_NEAR(totals(damped.mesh).energy(), kinetic, 1e-13 * kinetic);
    EXPECT_EQ(totals(damped.mesh).hourglass_energy, 0.0);
    EXPECT_NEAR(totals(damped.mesh).internal_energy, kinetic * (1.0 - std::exp(-2.0)), 5e-3 * kinetic);
  }
}

/// Growth of a small disturbance after `steps` steps at a multiple of the bound.
double growth(Body& body, double factor, int steps) {
  std::mt19937_64 generator(9);
  std::uniform_real_distribution<double> uniform(-1e-6, 1e-6);
  body.set_velocity(
      [&](const Vector3&) { return Vector3(uniform(generator), uniform(generator), uniform(generator)); });
  const double before = totals(body.mesh).kinetic_energy, dt = factor * body.critical_time_step();
  for (int i = 0; i < steps; ++i) body.step(dt);
  return totals(body.mesh).kinetic_energy / before;
}

/// The bound is safe for any element, and sharp: a cube of fluid is unstable 1 % above it.
TEST(TimeStep, BoundIsSafeAndSharpForAFluidCube) {
  Solid fluid;
  fluid.shear_modulus = 1.0;  // Pa
  const auto cube = [&] {
    return Body(fluid.material(), fem::make_box(Vector3::Zero(), Vector3::Constant(1e-3), {1, 1, 1}),
                Quadrature::one_point);
  };
  Body below = cube(), above = cube();
  below.hourglass = above.hourglass = no_control;
  EXPECT_NEAR(below.critical_time_step(), 1e-3 / (std::sqrt(3.0) * fluid.longitudinal_speed()), 1e-9 * 1e-7);
  EXPECT_LT(growth(below, 0.999, 2000), 50.0);
  EXPECT_GT(growth(above, 1.01, 200), 1e6);
}

TEST(TimeStep, BoundIsSafeForDistortedMeshes) {
  for (const Quadrature quadrature : both) {
    for (const auto& control : {stiffness, viscous}) {
      Body body(Solid{}.material(), distorted_box(4, 1e-3, 0.25), quadrature);
      body.hourglass = control;
      EXPECT_LT(growth(body, 0.999, 1000), 10.0) << name(quadrature);
    }
  }
}

/// With artificial viscosity the bound is lower; it stays safe in strong compression.
TEST(TimeStep, BoundCountsTheViscosity) {
  Body body(Solid{}.material(), fem::make_box(Vector3::Zero(), Vector3::Constant(4e-3), {4, 4, 4}),
            Quadrature::one_point);
  const double plain = body.critical_time_step();
  body.viscosity = {0.25, 1.0};
  const double xi = std::sqrt(3.0) * 0.25;
  EXPECT_NEAR(body.critical_time_step(), plain * (std::sqrt(1.0 + xi * xi) - xi), 1e-12 * plain);
  const double bound = body.critical_time_step();
  for (double& q : body.mesh.points.artificial_viscosity) q = -1e9;  // in expansion: the linear part alone
  EXPECT_EQ(body.critical_time_step(), bound);
  EXPECT_EQ(fem::critical_time_step(body.mesh, 0, body.viscosity),
            fem::critical_time_step(body.mesh, 63, body.viscosity));
  for (double& q : body.mesh.points.artificial_viscosity) q = 0.0;
  EXPECT_LT(growth(body, 0.999, 1000), 1.0);  // it damps
}

/// Boundary conditions: what they do to momentum and energy is booked.
TEST(Boundary, PrescribedVelocityBooksImpulseAndWork) {
  for (const Quadrature quadrature : both) {
    Body body = shaken(quadrature, stiffness, 0.25);
    std::vector<std::uint32_t> piston, wall;
    for (std::uint32_t a = 0; a < body.mesh.nodes.size(); ++a) {
      const std::uint64_t id = body.mesh.nodes.id[a];  // 4 x 4 x 4
      if (id % 16 < 4) piston.push_back(a);
      if (id >= 48) wall.push_back(a);
    }
    constrain(body.mesh.nodes, piston, fem::constraint::x | fem::constraint::y, Vector3(150.0, -20.0, 1e9));
    constrain(body.mesh.nodes, wall, fem::constraint::z);
    const fem::MeshTotals before = totals(body.mesh);
    for (int i = 0; i < 100; ++i) body.step(0.5 * body.critical_time_step());
    const fem::MeshTotals now = totals(body.mesh);
    EXPECT_NEAR(now.energy(), before.energy() + body.boundary.work, 1e-12 * before.energy())
        << name(quadrature);
    EXPECT_LT((now.momentum - before.momentum - body.boundary.impulse).norm(), 1e-12 * before.momentum_scale);
    EXPECT_GT(std::abs(body.boundary.work), 1e-3 * before.energy());
    for (const std::uint32_t a : piston) {
      EXPECT_EQ(body.mesh.nodes.velocity[a].x(), 150.0);
      EXPECT_EQ(body.mesh.nodes.velocity[a].y(), -20.0);
    }
    for (const std::uint32_t a : wall) EXPECT_EQ(body.mesh.nodes.velocity[a].z(), 0.0);
  }
}

/// An element that a step turns inside out is named. Of its neighbours, two keep their volume, but not a
/// positive Jacobian at every Gauss point.
TEST(Inversion, IsReportedWithItsElement) {
  for (const Quadrature quadrature : both) {
    Body body(Solid{}.material(), fem::make_box(Vector3::Zero(), Vector3::Constant(3.0), {3, 3, 3}),
              quadrature);
    body.motion.mean.assign(body.mesh.nodes.size(), Vector3::Zero());
    body.motion.end = body.motion.mean;
    std::size_t corner = 0;  // element at the origin: its upper face goes through the lower one
    for (std::size_t e = 0; e < 27; ++e) corner = body.mesh.elements.id[e] == 0 ? e : corner;
    for (std::size_t a = 0; a < 8; ++a) {
      const std::uint32_t node = body.mesh.elements.corners[corner][a];
      if (body.mesh.nodes.position[node].z() < 0.5) body.motion.end[node] = Vector3(0, 0, 1.5);
    }
    const fem::DeformationReport report = fem::deform(body.mesh, body.motion, 1.0, stiffness, body.gradients);
    EXPECT_EQ(report.inverted, quadrature == Quadrature::one_point ? 1U : 3U) << name(quadrature);
    EXPECT_EQ(report.first_inverted, corner);
    const fem::DeformationReport still =
        fem::deform(body.mesh, {body.motion.mean, body.motion.mean}, 1.0, stiffness, body.gradients);
    EXPECT_EQ(still.inverted, 0U);
    EXPECT_EQ(still.first_inverted, fem::DeformationReport::none);
  }
}

TEST(Heat, GivenAtNodesGoesToTheirElementsByMass) {
  for (const Quadrature quadrature : both) {
    Body body(Solid{}.material(), distorted_box(2, 1e-3, 0.2), quadrature);
    std::vector<double> heat(body.mesh.nodes.size(), 0.0);
    const auto node = [&](std::uint64_t id) {
      return static_cast<std::size_t>(std::ranges::find(body.mesh.nodes.id, id) - body.mesh.nodes.id.begin());
    };
    heat[node(13)] = 5.0;  // the middle node: all eight elements
    heat[node(0)] = 2.0;   // a corner: one element
    ASSERT_EQ(body.mesh.elements.id[0], 0U);
    add_heat(body.mesh, heat);
    EXPECT_NEAR(totals(body.mesh).internal_energy, 7.0, 1e-13);
    const std::size_t n = points_per_element(quadrature);
    const double first = body.mesh.points.specific_internal_energy[0] * fem::mass(body.mesh, 0);
    const double share = 5.0 * fem::corner_mass(body.mesh, 0, 6) / body.mesh.nodes.mass[node(13)];
    EXPECT_NEAR(first, 2.0 + share, 1e-12);
    EXPECT_EQ(body.mesh.points.specific_internal_energy[n - 1], body.mesh.points.specific_internal_energy[0]);
  }
}

// The time step of a mesh is that of its stiffest element, wherever it stands and whatever the others are:
// equal to it, a little less stiff, or far from it.
TEST(CriticalTimeStep, IsThatOfTheStiffestElement) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const Quadrature quadrature : both) {
    for (const double spread : {0.0, 1e-12, 1e-3, 0.9}) {
      for (int trial = 0; trial < 20; ++trial) {
        Body body = shaken(quadrature, stiffness, 0.25);
        fem::GaussPoints& points = body.mesh.points;
        for (std::size_t i = 0; i < points.size(); ++i) {
          points.sound_speed[i] = 5000.0 * (1.0 - spread * uniform(generator));
          points.length[i] = 1e-3 * (1.0 - spread * uniform(generator));
          points.artificial_viscosity[i] = i % 3 == 0 ? 0.0 : 1e9 * uniform(generator) * spread;
        }
        for (const fem::ViscosityCoefficients viscosity :
             {fem::ViscosityCoefficients{}, {0.0, 2.0}, {0.1, 0.0}}) {
          double least = std::numeric_limits<double>::infinity();
          for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
            least = std::min(least, critical_time_step(body.mesh, e, viscosity));
          }
          EXPECT_NEAR(critical_time_step(body.mesh, viscosity), least, 1e-15 * least);
        }
      }
    }
  }
}

}  // namespace
}  // namespace whipple::fem_test

// SPDX-License-Identifier: BSD-3-Clause
// The smoothed particles of docs/manual/performance.md: exact balances and gradients, the Hugoniot, the bar.
#include "tests/benchmark/sph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/folders.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

/// A block of aluminium at the corner of three planes of symmetry, 20 particles along each edge.
cases::Case corner_block(const std::string& velocity) {
  return cases::read_case_text(
      "[domain]\nlower = [0, 0, 0]\nupper = [0.02, 0.02, 0.02]\ncell_size = 1e-3\n"
      "boundary = { x_lower = \"symmetry\", y_lower = \"symmetry\", z_lower = \"symmetry\" }\n"
      "[time]\nend = 1e-6\n[[body]]\nname = \"block\"\nmaterial = \"" +
          aluminium("sph_aluminium", "1 kPa") + "\"\nvelocity = [" + velocity +
          ", 0, 0]\nshape = { box = { lower = [0, 0, 0], upper = [0.01, 0.01, 0.01] } }\n",
      "block.toml");
}

TEST(SmoothedParticles, LinearVelocityFieldsHaveExactGradients) {
  const cases::Case setup = corner_block("0");
  sph::Simulation simulation(setup, {.linear_viscosity = 0.0, .quadratic_viscosity = 0.0});
  Particles& q = simulation.particles();
  Matrix3 rate = Matrix3::Zero();  // of those that the planes of symmetry allow
  rate.diagonal() << 1.0, -2.0, 0.5;
  for (std::size_t i = 0; i < q.size(); ++i) q.velocity[i] = rate * q.position[i];
  simulation.advance(1e-6);
  for (const Matrix3& found : simulation.gradients()) ASSERT_LT((found - rate).norm(), 1e-6);
}

// The wall alone changes momentum; energy is exact at every step.
TEST(SmoothedParticles, KeepEnergyAndLateralMomentum) {
  const cases::Case setup = cases::read_case(whipple::tests::source_folder() + "/cases/taylor_bar/case.toml",
                                             {{"domain.cell_size", "1.52 mm"},
                                              {"domain.lower", "['-6.08 mm', '-6.08 mm', '0 mm']"},
                                              {"domain.boundary.x_lower", "outflow"},
                                              {"domain.boundary.y_lower", "outflow"}});
  sph::Simulation simulation(setup);
  const double start = simulation.kinetic_energy() + simulation.internal_energy();
  while (simulation.time() < 10e-6) {
    simulation.advance(10e-6);
    ASSERT_NEAR(simulation.kinetic_energy() + simulation.internal_energy(), start, 1e-13 * start);
  }
  const Particles& q = simulation.particles();
  Vector3 momentum = Vector3::Zero();
  double scale = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    momentum += q.mass[i] * q.velocity[i];
    scale += q.mass[i] * q.velocity[i].norm();
  }
  EXPECT_LT(momentum.head<2>().norm(), 1e-13 * scale);
  EXPECT_GT(*std::ranges::max_element(q.plastic_strain), 0.1);
}

// Near the axis and the wall, before the release of the sides arrives: p = rho_0 (c_0 + s u) u and the Hugoniot density.
TEST(SmoothedParticles, ABlockOnAWallIsOnTheHugoniot) {
  constexpr double speed = 500.0, density = 2785.0, c0 = 5328.0, s = 1.338;
  const cases::Case setup = corner_block("-500");
  sph::Simulation simulation(setup);
  while (simulation.time() < 0.9e-6) simulation.advance(0.9e-6);
  const Particles& q = simulation.particles();
  double mass = 0.0, stress = 0.0, volume = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Vector3& x = q.position[i];
    if (x.x() < 1.0e-3 || x.x() > 3.0e-3 || x.tail<2>().norm() > 2.5e-3) continue;
    mass += q.mass[i];
    volume += q.volume[i];
    stress += q.mass[i] * (q.pressure[i] - q.deviatoric_stress[i].matrix()(0, 0));
  }
  ASSERT_GT(mass, 0.0);
  const double shock = c0 + s * speed;
  EXPECT_NEAR(stress / mass, density * shock * speed, 0.01 * density * shock * speed);
  EXPECT_NEAR(mass / volume, density / (1.0 - speed / shock), 0.005 * density);
}

}  // namespace
}  // namespace whipple::verification

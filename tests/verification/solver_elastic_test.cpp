// SPDX-License-Identifier: BSD-3-Clause
// Bending of a free-free beam and rotation of a sphere: most sensitive to a dissipative or unbalanced transfer.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "tests/folders.hpp"
#include "tests/verification/same_state.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

constexpr double bulk = 2785.0 * 5328.0 * 5328.0, shear = 27.6e9;

std::string elastic_case(const Method& method, double end, const std::string& domain,
                         const std::string& body) {
  return method.time_toml(end) + method.toml() + "[output]\nmaximum_energy_error = 10.0\n" + domain +
         "\n[[body]]\nname = \"body\"\nmaterial = \"" + elastic_aluminium() + "\"\n" + body;
}

/// Elastic energy: pressure part K/2 (V/V0 - 1)^2, deviator s:s / 4G.
double elastic_energy(const Particles& q) {
  double sum = 0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double v0 = q.mass[p] / 2785.0;
    const double dilatation = q.volume[p] / v0 - 1;
    sum += 0.5 * bulk * dilatation * dilatation * v0 +
           q.deviatoric_stress[p].squared_norm() / (4 * shear) * q.volume[p];
  }
  return sum;
}

/// Returns the fraction of the vibration energy lost per period in the first bending mode of a free-free beam of 24 x 3
/// x 3 cells.
double bending_loss(double courant) {
  constexpr double mm = 1e-3, length = 24 * mm, height = 3 * mm, amplitude = 10.0;
  constexpr double kl = 4.730041, sigma = 0.982502;
  const double youngs = 9 * bulk * shear / (3 * bulk + shear);
  const double period = length * length / (1.02773 * std::sqrt(youngs / 2785.0) * height);
  Method method;
  method.courant = courant;
  method.linear_viscosity = method.quadratic_viscosity = 0;
  const double end = 3 * period;
  const cases::Case setup = cases::read_case_text(
      elastic_case(
          method, end,
          "[domain]\nlower = [-0.008, -0.008, -0.008]\nupper = [0.032, 0.016, 0.016]\ncell_size = 0.001\n",
          "shape = { box = { lower = [0.00023, 0.000299, 0.000161], upper = [0.02423, 0.003299, 0.003161] } "
          "}\n"),
      "beam.toml");
  Particles particles = cases::seed(setup).particles;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vector3& x = particles.position[p];
    const double b = kl * (x[0] - 0.23 * mm) / length;
    const double y = x[1] - 0.299 * mm - 0.5 * height;
    const double mode = std::cosh(b) + std::cos(b) - sigma * (std::sinh(b) + std::sin(b));
    const double slope = kl / length * (std::sinh(b) - std::sin(b) - sigma * (std::cosh(b) + std::cos(b)));
    particles.velocity[p] = Vector3(-amplitude * slope / 2 * y, amplitude * mode / 2, 0);
    particles.affine_velocity[p].setZero();
    particles.affine_velocity[p](1, 0) = amplitude * slope / 2;
    particles.affine_velocity[p](0, 1) = -amplitude * slope / 2;
  }
  solver::RunState state;
  state.ledger.initial = solver::totals_of(particles, 0.25 * mm * mm);
  solver::Simulation simulation(setup, particles, state, parallel::world());
  const auto mechanical = [&] {
    const solver::Totals& t = simulation.totals();
    return t.kinetic_energy + t.affine_kinetic_energy - t.momentum.squaredNorm() / (2 * t.mass) +
           elastic_energy(simulation.particles());
  };
  const double start = mechanical();
  EnergyWatch watch;
  run_to(simulation, end, std::ref(watch));
  const double loss = 1 - std::cbrt(mechanical() / start);
  std::printf("beam, courant %.2f: loss per period %.2f %%, %lld steps, energy error %.1e\n", courant,
              100 * loss, static_cast<long long>(simulation.state().step), watch.worst);
  EXPECT_LT(watch.worst, 1e-12);
  return loss;
}

TEST(Beam, BendingKeepsItsEnergyForEveryTimeStep) {
  // The exact value is 0. Full APIC loses 6 % and 12 % per period at these two time steps; the relaxed transfer 0.74
  // and 0.72 % over the first three periods. Two-sided, so that any change of the scheme is noticed.
  EXPECT_NEAR(bending_loss(0.5), 0.0074, 0.0003);
  EXPECT_NEAR(bending_loss(0.25), 0.0072, 0.0003);
}

TEST(Sphere, RotationKeepsAngularMomentumAndStaysCold) {
  // Radius 4 cells, rim speed 300 m/s, two turns.
  constexpr double radius = 4e-3, rim = 300.0;
  const double omega = rim / radius, end = 2 * 2 * std::numbers::pi / omega;
  Method method;
  char body[256];
  std::snprintf(body, sizeof body,
                "angular_velocity = [0, 0, %.17g]\nshape = { sphere = { center = [0.00023, 0.000299, "
                "0.000161], radius = "
                "0.004 } }\n",
                omega);
  const cases::Case setup = cases::read_case_text(
      elastic_case(method, end,
                   "[domain]\nlower = [-0.01, -0.01, -0.01]\nupper = [0.01, 0.01, 0.01]\ncell_size = 0.001\n",
                   body),
      "sphere.toml");
  solver::Simulation simulation(setup, parallel::world());
  const auto angular_momentum = [&] {
    const Particles& q = simulation.particles();
    double sum = 0;
    for (std::size_t p = 0; p < q.size(); ++p) {
      const Vector3& x = q.position[p];
      const Vector3& v = q.velocity[p];
      const Matrix3& c = q.affine_velocity[p];
      sum += q.mass[p] * (x[0] * v[1] - x[1] * v[0] + 0.25e-6 * (c(1, 0) - c(0, 1)));
    }
    return sum;
  };
  const double l0 = angular_momentum();
  const double k0 = simulation.totals().energy();
  EnergyWatch watch;
  run_to(simulation, end, std::ref(watch));
  const double l = angular_momentum() / l0 - 1;
  const double heat = simulation.totals().internal_energy / k0;
  std::printf(
      "sphere, two turns: angular momentum %+.2e, internal energy %.2e of the kinetic energy, energy error "
      "%.1e\n",
      l, heat, watch.worst);
  EXPECT_LT(std::abs(l), 2e-3);  // -1.1e-3; FLIP -13 %, linear MUSL -20 %
  EXPECT_LT(heat, 5e-3);         // 3.6e-3, of which 1e-3 is elastic stretch; FLIP 22 %
  EXPECT_LT(watch.worst, 1e-12);
}

/// Returns a case of a block of neo-Hookean rubber, 6 x 4 x 4 mm, that flies against a separating wall at 5 m/s.
cases::Case rubber_block() {
  Method method;
  method.linear_viscosity = method.quadratic_viscosity = 0;
  return cases::read_case_text(
      method.time_toml(4e-4) + method.toml() +
          "[domain]\nlower = [0, -0.004, -0.004]\nupper = [0.012, 0.008, 0.008]\ncell_size = 0.001\n"
          "boundary = { x_lower = \"separating\" }\n"
          "[[body]]\nname = \"block\"\nmaterial = \"" +
          whipple::tests::source_folder() +
          "/tests/data/rubber.toml\"\nvelocity = [-5, 0, 0]\n"
          "shape = { box = { lower = [0.0012, 0, 0], upper = [0.0072, 0.004, 0.004] } }\n",
      "rubber.toml");
}

TEST(Rubber, BlockBouncesOffAWallWithoutLossAndRestartsBitwise) {
  const cases::Case setup = rubber_block();
  solver::Simulation simulation(setup, parallel::world());
  EnergyWatch watch;
  double largest_stretch = 0.0;
  run_to(simulation, 8e-5, std::ref(watch));
  const TemporaryFolder folder;
  solver::Simulation again = restored(setup, save(simulation, folder.path()), parallel::world());
  const Particles& q = simulation.particles();
  run_to(simulation, 4e-4, [&](const solver::Simulation& s) {
    watch(s);
    for (const Matrix3& f : q.history.values<Matrix3>("deformation_gradient")) {
      largest_stretch = std::max(largest_stretch, (f - Matrix3::Identity()).norm());
    }
  });
  run_to(again, 4e-4);
  expect_same(simulation, again);
  const solver::Totals& t = simulation.totals();
  const double rebound = t.momentum[0] / t.mass;
  std::printf("rebound %.3f m/s, |F - 1| up to %.3f, energy error %.1e\n", rebound, largest_stretch,
              watch.worst);
  EXPECT_LT(watch.worst, 1e-12);
  EXPECT_GT(largest_stretch, 0.05);
  EXPECT_GT(rebound, 3.5);
  EXPECT_LT(rebound, 5.0);  // the block vibrates
  EXPECT_EQ(simulation.state().ledger.dissipation, 0.0);
  // F is consistent with the density of its point, which the step advances separately.
  const auto& deformation = q.history.values<Matrix3>("deformation_gradient");
  for (std::size_t p = 0; p < q.size(); ++p) {
    EXPECT_NEAR(deformation[p].determinant(), q.volume[p] * 1000.0 / q.mass[p], 1e-10);
  }
}

}  // namespace
}  // namespace whipple::verification

// SPDX-License-Identifier: BSD-3-Clause
// A wall with Coulomb friction (docs/theory/mpm.md, equation 3.13): a block that slides on it, stops, and stays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/verification/contact_problems.hpp"

namespace whipple::verification {
namespace {

constexpr double dx = 1e-3, g = 1e6, height = 6 * dx;  // m, m/s^2

/// A block of 10 x 6 cells on the lower face of the domain, without lateral stress.
struct Block {
  double friction = 0.3, speed = 0.0, angle = 0.0;  // m/s, rad (gravity is rotated, not the wall)
  double rise_time = 0.0;                           // of gravity, s; 0: in its weight from the start
  Method method{};

  [[nodiscard]] cases::Case read(double end) const {
    const Vector3 gravity = g * Vector3(std::sin(angle), -std::cos(angle), 0.0);
    const std::string initial =
        rise_time == 0.0 ? "initial = { lithostatic = { surface = 0.006, k0 = 0 } }\n" : "";
    return cases::read_case_text(
        method.time_toml(end) + method.toml() + "[output]\nmaximum_energy_error = 10.0\n[domain]\n" +
            "dimension = \"plane_strain\"\nlower = [0, 0]\nupper = [0.024, 0.010]\ncell_size = "
            "0.001\nfriction = " +
            number(friction) + "\nboundary = { y_lower = \"friction\" }\n[gravity]\nacceleration = " +
            vector3(gravity) + "\nrise_time = " + number(rise_time) + "\n" +
            BodyOptions{"block",
                        elastic_aluminium(),
                        box({4.3 * dx, 0, -1}, {14.3 * dx, height, 1}),
                        {speed, 0, 0},
                        initial}
                .toml(),
        "block.toml");
  }
};

struct Slide {
  double distance = 0.0;                // m
  Vector3 gained, impulse;              // of the block, and by the wall, N s
  double energy = 0.0, momentum = 0.0;  // largest errors
  double heat = 0.0, kinetic = 0.0, mass = 0.0;
};

Slide slide(const Block& block, double end) {
  solver::Simulation simulation(block.read(end), parallel::world());
  const BodySums start = sums_of(simulation.particles(), 0, 0.0);
  Slide result;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    result.energy = std::max(result.energy, std::abs(s.state().ledger.energy_error(s.totals())));
    result.momentum = std::max(result.momentum, s.state().ledger.momentum_error(s.totals()));
    EXPECT_GE(s.state().ledger.contact_heat, result.heat - 1e-12);  // never given back
    result.heat = s.state().ledger.contact_heat;
  });
  const BodySums stop = sums_of(simulation.particles(), 0, 0.0);
  result.distance = stop.centre[0] - start.centre[0];
  result.gained = stop.momentum - start.momentum;
  result.impulse = simulation.state().ledger.wall_impulse;
  result.mass = stop.mass;
  result.kinetic = simulation.totals().kinetic_energy;
  std::printf(
      "friction %.2f, %4.1f m/s, angle %.3f: distance %.6e m, wall %.6e %.6e N s, heat %.6e J, energy %.1e, "
      "momentum %.1e\n",
      block.friction, block.speed, block.angle, result.distance, result.impulse[0], result.impulse[1],
      result.heat, result.energy, result.momentum);
  return result;
}

void expect_exact_balances(const Slide& s) {
  EXPECT_LT(s.energy, 1e-12);
  EXPECT_LT(s.momentum, 1e-12);
}

// While every point slides, the tangential impulse is the coefficient times the normal one, at every node. Points that
// keep their own velocities (FLIP) let nodes of little mass at the edges stick at times.
TEST(FrictionWall, ImpulseIsTheCoefficientTimesTheNormalOneWhileABlockSlides) {
  for (const auto& [update, error] : {std::pair{"relaxed_affine", 1e-12}, {"apic", 1e-12}, {"flip", 1e-8}}) {
    const Slide s = slide({.friction = 0.3, .speed = 20.0, .method = {.particle_update = update}}, 30e-6);
    expect_exact_balances(s);
    EXPECT_NEAR(s.impulse[0], -0.3 * s.impulse[1], error * s.impulse[1]) << update;
    EXPECT_NEAR(s.impulse[1] - s.gained[1], s.mass * g * 30e-6, 1e-12 * s.impulse[1])
        << update;  // its weight
    EXPECT_NEAR(s.impulse[1], s.mass * g * 30e-6, 0.05 * s.impulse[1]) << update;
  }
}

TEST(FrictionWall, ABlockStopsAfterTheDistanceOfItsFriction) {
  for (const double friction : {0.2, 0.4}) {
    const double speed = 12.0, time = speed / (friction * g);
    const Slide s = slide({.friction = friction, .speed = speed}, 1.5 * time);
    expect_exact_balances(s);
    const double exact = speed * speed / (2.0 * friction * g);
    EXPECT_NEAR(s.distance, exact, 0.02 * exact) << friction;  // it leans as it stops
    const double before = 0.5 * s.mass * speed * speed;
    EXPECT_LT(s.kinetic, 1e-2 * before);  // it vibrates
    EXPECT_GT(s.heat, 0.9 * before);      // the rest went into the shear of the block
    EXPECT_LT(s.heat, 1.001 * before);
  }
}

TEST(FrictionWall, ABlockStaysBelowTheAngleOfFrictionAndSlidesBeyond) {
  constexpr double end = 50e-6, angle = std::numbers::pi / 6, rise = 0.3 * end;
  const double tangent = std::tan(angle), free = 0.5 * g * std::sin(angle) * end * end;
  Method method;
  method.first_step =
      1.0;  // errors are relative to the contribution of gravity, which is nearly zero at first
  const Slide stays =
      slide({.friction = 1.2 * tangent, .angle = angle, .rise_time = rise, .method = method}, end);
  expect_exact_balances(stays);
  // It leans by its elasticity: rho g sin(angle) h^2/(3 G) on average, and vibrates about that.
  const double lean = 2785.0 * g * std::sin(angle) * height * height / (3.0 * 27.6e9);
  EXPECT_LT(stays.distance, 2.0 * lean);
  EXPECT_GT(stays.distance, 0.0);
  const Slide slides =
      slide({.friction = 0.4 * tangent, .angle = angle, .rise_time = rise, .method = method}, end);
  expect_exact_balances(slides);
  EXPECT_NEAR(slides.impulse[0], -0.4 * tangent * slides.impulse[1], 1e-3 * slides.impulse[1]);
  EXPECT_GT(slides.distance, 0.3 * free);
}

TEST(FrictionWall, WithoutCoefficientIsTheSeparatingWall) {
  const Block block{.friction = 0.0, .speed = 5.0};
  cases::Case setup = block.read(10e-6);
  solver::Simulation rough(setup, parallel::world());
  setup.domain.boundary.y_lower = grid::Boundary::separating;
  setup.geometry.boundary[2] = grid::Boundary::separating;
  solver::Simulation smooth(setup, parallel::world());
  run_to(rough, 10e-6);
  run_to(smooth, 10e-6);
  for (std::size_t p = 0; p < rough.particles().size(); ++p) {
    ASSERT_EQ(rough.particles().position[p], smooth.particles().position[p]);
  }
}

}  // namespace
}  // namespace whipple::verification

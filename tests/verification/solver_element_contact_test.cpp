// SPDX-License-Identifier: BSD-3-Clause
// Contact of bodies of elements with each other and with particles (docs/theory/contact.md, 3 and 6).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "src/core/parallel/threads.hpp"
#include "tests/verification/contact_problems.hpp"
#include "tests/verification/same_state.hpp"

namespace whipple::verification {
namespace element_contact_test {

const std::string elements = "discretization = { method = \"finite_elements\" }\n";
const std::string particles = "";

/// Largest errors of energy and momentum so far.
struct Watch {
  double energy = 0.0, momentum = 0.0;
  void operator()(const solver::Simulation& s) {
    energy = std::max(energy, std::abs(s.state().ledger.energy_error(s.totals())));
    momentum = std::max(momentum, s.state().ledger.momentum_error(s.totals()));
  }
};

struct Rebound {
  double restitution;   // exact: 1
  double contact_heat;  // over the kinetic energy
};

/// Two elastic bars of 20 mm meet head-on at 2 x 20 m/s; column of one cell. Exact: each leaves with its
/// velocity reversed.
Rebound rebound(int cells, const std::string& of_left, const std::string& of_right) {
  constexpr double length = MeetingBars::length, speed = MeetingBars::speed;
  const MeetingBars bars(cells);
  const Problem problem = bars.problem(of_left, of_right);
  const double dx = bars.dx;
  solver::Simulation simulation(problem.read(), parallel::world());
  Watch watch;
  run_to(simulation, problem.end, [&](const solver::Simulation& s) {
    watch(s);
    if (s.state().time < bars.touch() * (1 - 1e-9)) {  // the gap test holds for surfaces of elements
      EXPECT_EQ(s.state().ledger.contact_impulse, 0.0);
    }
  });
  const BodySums left = sums_of(simulation, 0), right = sums_of(simulation, 1);
  const solver::Ledger& ledger = simulation.state().ledger;
  const Rebound result = {right.momentum[0] / (right.mass * speed),
                          ledger.contact_heat / ledger.initial.kinetic_energy};
  std::printf(
      "bars of %d cells, %s on %s: restitution %.4f, contact heat %.2e, transfer heat %.2e of the kinetic "
      "energy, clearance %.2f cells, energy %.1e, momentum %.1e\n",
      cells, of_left.empty() ? "particles" : "elements", of_right.empty() ? "particles" : "elements",
      result.restitution, result.contact_heat, ledger.transfer_heat / ledger.initial.kinetic_energy,
      (right.centre[0] - left.centre[0] - length) / dx, watch.energy, watch.momentum);
  EXPECT_LT(watch.energy, 1e-12);
  EXPECT_LT(watch.momentum, 1e-13);
  EXPECT_GE(ledger.contact_heat, 0.0);
  EXPECT_GE(ledger.transfer_heat, -1e-15 * ledger.initial.kinetic_energy);
  EXPECT_NEAR(left.momentum[0], -right.momentum[0], 1e-12 * right.mass * speed);
  EXPECT_GT(right.centre[0] - left.centre[0], length);
  return result;
}

TEST(ElementContact, BarsReboundAndPart) {
  for (const auto& [left, right] : {std::pair(elements, elements), std::pair(elements, particles)}) {
    const Rebound coarse = rebound(20, left, right), fine = rebound(40, left, right);
    EXPECT_GT(coarse.restitution, 0.92);
    EXPECT_GT(fine.restitution, coarse.restitution);
    EXPECT_LT(1.0 - fine.restitution, 0.75 * (1.0 - coarse.restitution));
    if (left != right) continue;
    // The heat of contact is that of the outermost nodes, half a cell of each bar, which stop at once (5.7): h/(2 L).
    for (const auto& [cells, heat] : {std::pair(20, coarse.contact_heat), std::pair(40, fine.contact_heat)}) {
      EXPECT_GT(heat, 0.5 / cells);
      EXPECT_LT(heat, 1.2 * 0.5 / cells);
    }
  }
}

/// A block of 10 x 6 cells on a slab that is inclined by 30 degrees (gravity is rotated, not the slab); plane strain.
/// Gravity grows over several vibration periods of the block; the second half of the time is evaluated.
/// @returns mean acceleration along the slope over that of free fall
double slide(double friction, const std::string& of_slab, const std::string& of_block,
             double duration = 36e-6) {
  constexpr double dx = 1e-3, g = 1e6, angle = std::numbers::pi / 6;
  Problem problem;
  problem.end = duration;
  problem.domain =
      "[domain]\nlower = [0, 0, 0]\nupper = [0.028, 0.013, 0.001]\ncell_size = 0.001\n"
      "boundary = { x_lower = \"symmetry\", x_upper = \"symmetry\", y_lower = \"no_slip\", "
      "z_lower = \"symmetry\", z_upper = \"symmetry\" }\n";
  problem.contact = ContactOptions{.friction = friction}.toml();
  problem.more = "[gravity]\nacceleration = " + vector3(g * Vector3(std::sin(angle), -std::cos(angle), 0)) +
                 "\nrise_time = " + number(0.3 * duration) + "\n";
  problem.bodies = {
      {"slab", elastic_aluminium(), box({0, 0, 0}, {28 * dx, 4 * dx, dx}), Vector3::Zero(), of_slab},
      {"block", elastic_aluminium(), box({5.3 * dx, 4 * dx, 0}, {15.3 * dx, 10 * dx, dx}), Vector3::Zero(),
       of_block}};
  solver::Simulation simulation(problem.read(), parallel::world());
  run_to(simulation, 0.5 * duration);
  const BodySums start = sums_of(simulation, 1);
  run_to(simulation, duration);
  const BodySums block = sums_of(simulation, 1);
  const double fall = 0.5 * block.mass * g * duration;
  const Vector3 gained = block.momentum - start.momentum;
  const double result = (gained[0] + friction * gained[1]) / fall;
  const solver::Ledger& ledger = simulation.state().ledger;
  const solver::Totals& totals = simulation.totals();
  const double energy =
      (totals.energy() - ledger.initial.energy() - ledger.external_work) / ledger.external_work;
  const double momentum = (totals.momentum - ledger.wall_impulse - ledger.external_impulse).norm() /
                          ledger.external_impulse.norm();
  std::printf(
      "incline, block of %s on slab of %s, friction %.1f: acceleration %.5f g, exact %.5f; distance %.2e m, "
      "friction heat %.3e J; energy %.1e, momentum %.1e\n",
      of_block.empty() ? "particles" : "elements", of_slab.empty() ? "particles" : "elements", friction,
      result, std::max(std::sin(angle) - friction * std::cos(angle), 0.0), block.centre[0] - start.centre[0],
      ledger.friction_heat, energy, momentum);
  EXPECT_LT(std::abs(energy), 1e-12);
  EXPECT_LT(momentum, 1e-12);
  EXPECT_GE(ledger.contact_heat, 0.0);
  EXPECT_GE(ledger.friction_heat, 0.0);
  return result;
}

TEST(ElementContact, ABlockSlidesDownAnInclineAsFrictionLetsIt) {
  const double sine = 0.5, cosine = std::sqrt(0.75);
  EXPECT_NEAR(slide(0.2, particles, elements), sine - 0.2 * cosine, 2e-4 * sine);
  EXPECT_NEAR(slide(0.2, elements, particles), sine - 0.2 * cosine, 2e-4 * sine);
  EXPECT_NEAR(slide(0.0, elements, elements), sine, 2e-4 * sine);
}

/// Returns a case of an adaptive body of aluminium at 2 km/s, oblique, on an adaptive layer next to a plate of
/// particles.
Problem impact(const ContactOptions& contact, const std::string& projectile, bool half = false) {
  Problem problem;
  problem.end = 2e-6;
  problem.domain = std::string("[domain]\nlower = [-0.01, ") + (half ? "0" : "-0.009") +
                   ", -0.01]\nupper = [0.01, 0.009, 0.012]\ncell_size = 0.001\n" +
                   (half ? "boundary = { y_lower = \"symmetry\" }\n" : "");
  problem.contact = contact.toml();
  const std::string material = aluminium("element_contact", "0.3 GPa");
  const std::string adaptive =
      "discretization = { method = \"adaptive\" }\nconversion = { plastic_strain = 0.3 }\n";
  problem.bodies = {
      {"projectile", material, projectile, {500, 0, 2000}, adaptive},
      {"layer", material, box({-5e-3, -5.8e-3, 0}, {-1e-3, 5.8e-3, 2e-3}), Vector3::Zero(), adaptive},
      {"plate", material, box({-1e-3, -6e-3, 0}, {6e-3, 6e-3, 2e-3})}};
  return problem;
}

const std::string ball = sphere({0, 0, -3.2e-3}, 3.1e-3);

TEST(ElementContact, KeepsMomentumAndEnergyWhileElementsBecomeParticles) {
  for (const char* normal : {"collinear", "separating", "logistic_regression"}) {
    solver::Simulation simulation(impact({.normal = normal, .friction = 0.3}, ball).read(),
                                  parallel::world());
    Watch watch;
    run_to(simulation, 1.2e-6, std::ref(watch));
    const solver::Ledger& ledger = simulation.state().ledger;
    EXPECT_LT(watch.energy, 1e-12) << normal;
    EXPECT_LT(watch.momentum, 1e-12) << normal;
    EXPECT_GT(ledger.converted_mass, 0.0) << normal;
    EXPECT_GT(simulation.element_count(), 0U) << normal;
    EXPECT_GT(ledger.contact_impulse, 0.05 * ledger.initial.momentum_scale) << normal;
    EXPECT_GT(ledger.contact_heat, 0.0) << normal;
    EXPECT_GT(ledger.friction_heat, 0.0) << normal;
  }
}

// A block, as nodes on the plane and next to it must be in equivalent cells: the choice of the cell of a point on a
// face is not symmetric.
TEST(ElementContact, AMirrorPlaneEqualsRealImages) {
  const std::string block = box({-2e-3, -2.9e-3, -5.2e-3}, {2e-3, 2.9e-3, -0.2e-3});
  const auto run = [&](bool half) {
    solver::Simulation simulation(impact({.friction = 0.2}, block, half).read(), parallel::world());
    for (int step = 0; step < 20; ++step) simulation.advance(2e-8 * (step + 1));
    return std::pair(simulation.totals(), simulation.state().ledger);
  };
  const auto [half, half_ledger] = run(true);
  const auto [full, full_ledger] = run(false);
  EXPECT_GT(full_ledger.friction_heat, 0.0);
  EXPECT_NEAR(2 * half.kinetic_energy, full.kinetic_energy, 1e-10 * full.energy());
  EXPECT_NEAR(2 * half_ledger.contact_heat, full_ledger.contact_heat, 1e-9 * full_ledger.contact_heat);
  EXPECT_NEAR(2 * half_ledger.friction_heat, full_ledger.friction_heat, 1e-9 * full_ledger.friction_heat);
}

TEST(ElementContact, DoesNotDependOnTheNumberOfThreads) {
  const auto run = [](int threads) {
    const int before = parallel::threads();
    parallel::set_threads(threads);
    solver::Simulation simulation(impact({.friction = 0.3}, ball).read(), parallel::world());
    for (int step = 0; step < 40; ++step) simulation.advance(2e-6);
    parallel::set_threads(before);
    return simulation.totals();
  };
  const solver::Totals one = run(1), three = run(3);
  EXPECT_EQ(one.kinetic_energy, three.kinetic_energy);
  EXPECT_EQ(one.internal_energy, three.internal_energy);
  EXPECT_EQ(one.momentum, three.momentum);
}

/// Computes force and time of Hertz's impact of equal elastic spheres (Timoshenko & Goodier, Theory of Elasticity,
/// section 142): mu d2delta/dt2 = -4/3 E* sqrt(R*) delta^(3/2).
struct Hertz {
  double largest_force = 0.0;  // N
  double duration = 0.0;       // s, from 5 to 95 % of the impulse

  Hertz(double mass, double radius, double speed) {
    constexpr double bulk = 2785.0 * 5328.0 * 5328.0, shear = 27.6e9;
    constexpr double young = 9 * bulk * shear / (3 * bulk + shear),
                     poisson = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
    const double modulus = young / (2 * (1 - poisson * poisson)), reduced = 0.5 * mass;
    const double stiffness = 4.0 / 3.0 * modulus * std::sqrt(0.5 * radius);
    const double dt = 1e-9;
    double depth = 0.0, velocity = speed, begin = 0.0;
    for (double t = 0.0; depth >= 0.0; t += dt) {
      const double force = stiffness * std::pow(depth, 1.5);
      largest_force = std::max(largest_force, force);
      velocity -= dt * force / reduced;
      depth += dt * velocity;
      const double given = (speed - velocity) / (2 * speed);
      if (given < 0.05) begin = t;
      if (given < 0.95) duration = t - begin;
    }
  }
};

/// Two equal spheres of elastic elements meet at 45 degrees to the line between their centres. Force and duration are
/// close to those of Hertz; the restitution is not: the contact area is two elements wide, and the loss decreases with
/// the element size (docs/theory/contact.md, 6). Its bound only detects a deterioration.
TEST(ElementContact, ObliqueImpactOfElasticSpheresBesideHertz) {
  constexpr double radius = 5e-3, speed = 200.0, dx = 2 * radius / 16;
  const Vector3 direction = Vector3(1.0, 0.8, 0.6) / std::numbers::sqrt2;  // from one centre to the other
  const Vector3 centre = (radius + 0.1 * dx) * direction;
  Problem problem;
  problem.method.linear_viscosity = problem.method.quadratic_viscosity = 0.0;
  problem.end = 16e-6;
  problem.domain =
      "[domain]\nlower = [-0.011, -0.011, -0.011]\nupper = [0.011, 0.011, 0.011]\ncell_size = " + number(dx) +
      "\n";
  problem.contact = ContactOptions{}.toml();
  problem.bodies = {{"left", elastic_aluminium(), sphere(-centre, radius), {0.5 * speed, 0, 0}, elements},
                    {"right", elastic_aluminium(), sphere(centre, radius), {-0.5 * speed, 0, 0}, elements}};
  solver::Simulation simulation(problem.read(), parallel::world());
  const BodySums before = sums_of(simulation, 1);
  Watch watch;
  std::vector<std::pair<double, double>> given;  // time, impulse so far
  run_to(simulation, problem.end, [&](const solver::Simulation& s) {
    watch(s);
    given.emplace_back(s.state().time, (sums_of(s, 1).momentum - before.momentum).norm());
  });
  const double total = given.back().second;
  const auto time_at = [&](double share) {
    return std::ranges::find_if(given, [&](const auto& point) { return point.second >= share * total; })
        ->first;
  };
  const double duration = time_at(0.95) - time_at(0.05);
  double force = 0.0;  // mean over a tenth of the duration
  for (std::size_t begin = 0, end = 0; end < given.size(); ++end) {
    while (given[end].first - given[begin].first > 0.1 * duration) ++begin;
    if (begin == 0) continue;
    force = std::max(
        force, (given[end].second - given[begin - 1].second) / (given[end].first - given[begin - 1].first));
  }
  const double normal_speed = speed * direction[0];
  const Hertz exact(before.mass, radius, normal_speed);
  const double restitution = 2.0 * total / (before.mass * normal_speed) - 1.0;
  std::printf(
      "spheres of %d cells: force %.3f, duration %.3f of Hertz's (%.3g N, %.3g s), restitution %.3f, energy "
      "%.1e, momentum %.1e\n",
      16, force / exact.largest_force, duration / exact.duration, exact.largest_force, exact.duration,
      restitution, watch.energy, watch.momentum);
  EXPECT_NEAR(force, exact.largest_force, 0.1 * exact.largest_force);
  EXPECT_NEAR(duration, exact.duration, 0.15 * exact.duration);
  EXPECT_GT(restitution, 0.6);  // exact: 1
  EXPECT_LT(restitution, 1.0);
  EXPECT_LT(watch.energy, 1e-12);
  EXPECT_LT(watch.momentum, 1e-12);
}

// Contact is determined again in each step; the checkpoint stores nothing of it.
TEST(ElementContact, ARestartIsBitwiseTheRunThatGoesOn) {
  const TemporaryFolder folder;
  const cases::Case setup = impact({.friction = 0.3}, ball).read();
  solver::Simulation whole(setup, parallel::world());
  for (int step = 0; step < 50; ++step) whole.advance(2e-6);
  solver::Simulation restarted = restored(setup, save(whole, folder.path()), parallel::world());
  const double before = whole.state().ledger.contact_impulse;
  for (int step = 0; step < 15; ++step) {
    whole.advance(2e-6);
    restarted.advance(2e-6);
  }
  EXPECT_GT(whole.state().ledger.converted_mass, 0.0);
  EXPECT_GT(whole.state().ledger.contact_impulse, 1.1 * before);
  expect_same(whole, restarted);
  EXPECT_EQ(whole.state().ledger.friction_heat, restarted.state().ledger.friction_heat);
}

}  // namespace element_contact_test
}  // namespace whipple::verification

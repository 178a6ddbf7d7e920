// SPDX-License-Identifier: BSD-3-Clause
// Contact of bodies with separate velocity fields (docs/theory/contact.md): conservation, independence of frame,
// threads and planes, and correct contact, sliding, sticking and separation of bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "src/core/parallel/threads.hpp"
#include "tests/verification/contact_problems.hpp"

namespace whipple::verification {
namespace {

/// Two elastic bars of 20 mm meet head-on at 2 x 20 m/s.
struct Rebound {
  double restitution, heat, clearance;
};
Rebound rebound(int cells, const std::string& method) {
  constexpr double length = MeetingBars::length, speed = MeetingBars::speed;
  const MeetingBars bars(cells);
  const Problem problem = bars.problem({}, {}, method);
  const double dx = bars.dx;
  solver::Simulation simulation(problem.read(), parallel::world());
  EnergyWatch watch;
  double momentum = 0;
  run_to(simulation, problem.end, [&](const solver::Simulation& s) {
    watch(s);
    momentum = std::max(momentum, s.state().ledger.momentum_error(s.totals()));
  });
  const BodySums left = sums_of(simulation.particles(), 0, 0), right = sums_of(simulation.particles(), 1, 0);
  const solver::Ledger& ledger = simulation.state().ledger;
  const Rebound result{right.momentum[0] / (right.mass * speed),
                       ledger.contact_heat / ledger.initial.kinetic_energy,
                       (right.centre[0] - left.centre[0] - length) / dx};
  std::printf(
      "bars of %d cells, %s: restitution %.4f, contact heat %.2e of the kinetic energy, clearance %.2f "
      "cells, "
      "energy "
      "%.1e, momentum %.1e\n",
      cells, method.c_str(), result.restitution, result.heat, result.clearance, watch.worst, momentum);
  EXPECT_LT(watch.worst, 1e-12);
  EXPECT_LT(momentum, 1e-13);
  EXPECT_NEAR(ledger.contact_impulse / (right.mass * speed), 1.0 + result.restitution, 1e-10) << method;
  return result;
}

// Exact: each bar leaves with its velocity reversed. The remaining vibration or heat is of first order.
TEST(Contact, BarsReboundAndPart) {
  for (const char* method : {"auto", "multi_field"}) {
    const Rebound coarse = rebound(20, method), fine = rebound(40, method);
    EXPECT_GT(coarse.restitution, 0.93) << method;  // 0.939, 0.937
    EXPECT_GT(fine.restitution, 0.96) << method;    // 0.963, 0.962
    EXPECT_LT(fine.heat, 0.55 * coarse.heat) << method;
    EXPECT_LT(fine.heat, 0.019) << method;  // 0.0007, 0.0184
    EXPECT_GT(coarse.clearance, 0.2) << method;
    EXPECT_GT(fine.clearance, 0.4) << method;
  }
}

/// A block of 10 x 6 cells on a slab that is inclined by 30 degrees (gravity is rotated, not the slab); plane strain.
/// Gravity grows over several vibration periods of the block; the second half of the time is evaluated. The impulse of
/// the slab is that of the weight plus the vertical momentum, which is eliminated in the balance along the slope.
struct Slide {
  double acceleration;  ///< mean, along the slope, over that of free fall
  double distance;      ///< m
};
Slide slide(double friction, double duration, const std::string& method) {
  constexpr double dx = 1e-3, g = 1e6, angle = std::numbers::pi / 6;
  Problem problem;
  problem.end = duration;
  // Errors are relative to the contribution of gravity, which is nearly zero at first
  problem.method.first_step = 1.0;
  problem.domain =
      "[domain]\nlower = [0, 0, 0]\nupper = [0.028, 0.013, 0.001]\ncell_size = 0.001\n"
      "boundary = { x_lower = \"symmetry\", x_upper = \"symmetry\", y_lower = \"no_slip\", "
      "z_lower = \"symmetry\", z_upper = \"symmetry\" }\n";
  problem.contact = ContactOptions{.friction = friction, .method = method}.toml();
  problem.bodies = {{"slab", elastic_aluminium(), box({0, 0, 0}, {28 * dx, 4 * dx, dx})},
                    {"block", elastic_aluminium(), box({5.3 * dx, 4 * dx, 0}, {15.3 * dx, 10 * dx, dx})}};
  solver::Simulation simulation(problem.read(), parallel::world());
  simulation.add_load(solver::uniform_load("slope", [=](double time) {
    return Vector3(Vector3(g * std::sin(angle), -g * std::cos(angle), 0) *
                   std::min(time / (0.3 * duration), 1.0));
  }));
  // Largest errors: relative to the contribution of gravity, as everything is at rest at first
  double energy = 0, momentum = 0;
  const auto watch = [&](const solver::Simulation& s) {
    energy = std::max(energy, std::abs(s.state().ledger.energy_error(s.totals())));
    momentum = std::max(momentum, s.state().ledger.momentum_error(s.totals()));
  };
  run_to(simulation, 0.5 * duration, watch);
  const BodySums start = sums_of(simulation.particles(), 1, 0);
  run_to(simulation, duration, watch);
  const BodySums block = sums_of(simulation.particles(), 1, 0);
  const double fall = 0.5 * block.mass * g * duration;
  const Vector3 gained = block.momentum - start.momentum;
  const Slide result{(gained[0] + friction * gained[1]) / fall, block.centre[0] - start.centre[0]};
  const solver::Ledger& ledger = simulation.state().ledger;
  std::printf(
      "incline, %s, friction %.1f: acceleration %.5f g, exact %.5f; distance %.3e m; friction heat %.3e J; "
      "energy "
      "%.1e, momentum %.1e\n",
      method.c_str(), friction, result.acceleration,
      std::max(std::sin(angle) - friction * std::cos(angle), 0.0), result.distance, ledger.friction_heat,
      energy, momentum);
  EXPECT_LT(energy, 1e-12);
  EXPECT_LT(momentum, 1e-12);
  EXPECT_GE(ledger.contact_heat, 0.0);
  EXPECT_GE(ledger.friction_heat, 0.0);
  return result;
}

TEST(Contact, ABlockSlidesDownAnInclineAsFrictionLetsIt) {
  const double sine = 0.5, cosine = std::sqrt(0.75);
  for (const char* method : {"auto", "multi_field"}) {
    EXPECT_NEAR(slide(0.0, 36e-6, method).acceleration, sine, 2e-4 * sine) << method;
    EXPECT_NEAR(slide(0.2, 36e-6, method).acceleration, sine - 0.2 * cosine, 2e-4 * sine) << method;
  }
}

TEST(Contact, ABlockSticksToAnInclineUnderTheAngleOfFriction) {
  constexpr double duration = 50e-6, free = 0.5 * 0.5e6 * 0.75 * duration * duration;  // without friction
  for (const char* method : {"auto", "multi_field"}) {
    EXPECT_LT(std::abs(slide(0.7, duration, method).distance), 5e-4 * free) << method;
  }
}

/// Returns a case of an aluminium sphere at 5 km/s, oblique, on a plate of two layers, whose edge it overlaps: three
/// bodies are in contact.
Problem impact(const Method& method, const ContactOptions& contact, const Vector3& boost = Vector3::Zero()) {
  Problem problem;
  problem.method = method;
  problem.end = 2e-6;
  problem.domain =
      "[domain]\nlower = [-0.012, -0.012, -0.01]\nupper = [0.012, 0.012, 0.012]\ncell_size = 0.001\n";
  problem.contact = contact.toml();
  const std::string material = aluminium("contact_aluminium", "0.3 GPa");
  problem.bodies = {
      {"sphere", material, sphere({0.1e-3, 0.2e-3, -3.2e-3}, 3.1e-3), Vector3(1000, 0, 5000) + boost},
      {"layer", material, box({-5e-3, -6e-3, 0}, {0.3e-3, 6e-3, 2e-3}), boost},
      {"plate", material, box({0.3e-3, -6e-3, 0}, {6e-3, 6e-3, 2e-3}), boost}};
  return problem;
}

TEST(Gravity, GivesItsMomentumToEveryBody) {
  Problem problem = impact({}, {});
  problem.more = "[gravity]\nacceleration = [0, 3e8, -1e8]\n";
  solver::Simulation simulation(problem.read(), parallel::world());
  const solver::Totals start = simulation.totals();
  for (int step = 0; step < 5; ++step) simulation.advance(2e-6);
  const solver::Totals& now = simulation.totals();
  const solver::RunState& state = simulation.state();
  const Vector3 given = now.mass * state.time * Vector3(0, 3e8, -1e8);
  EXPECT_LT((now.momentum - start.momentum - given).norm(), 1e-12 * start.momentum_scale);
  EXPECT_LT(state.ledger.momentum_error(now), 1e-12);
  EXPECT_LT(std::abs(state.ledger.energy_error(now)), 1e-12);
}

TEST(Load, AddsToGravityOnParticlesAndElementsAlike) {
  Problem problem = impact({}, {});
  problem.bodies[1].more = "discretization = { method = \"finite_elements\" }\n";
  problem.more = "[gravity]\nacceleration = [0, 3e8, -1e8]\n";
  solver::Simulation simulation(problem.read(), parallel::world());
  simulation.add_load(solver::uniform_load("lift", [](double) { return Vector3(0, -3e8, 0); }));
  const solver::Totals start = simulation.totals();
  for (int step = 0; step < 5; ++step) simulation.advance(2e-6);
  const solver::Totals& now = simulation.totals();
  const Vector3 given = now.mass * simulation.state().time * Vector3(0, 0, -1e8);
  EXPECT_LT((now.momentum - start.momentum - given).norm(), 1e-12 * start.momentum_scale);
  EXPECT_LT(std::abs(simulation.state().ledger.energy_error(now)), 1e-12);
}

// The material is at rest until the load begins, then all of it moves.
TEST(Load, WakesMaterialWhenItBegins) {
  const double begin = 1e-6, g = 1e8;
  Problem problem = impact({}, {});
  problem.bodies.resize(1);
  problem.bodies[0].velocity.setZero();
  solver::Simulation simulation(problem.read(), parallel::world());
  simulation.add_load(solver::uniform_load("late", [g](double) { return Vector3(0, 0, g); }, begin));
  run_to(simulation, begin, [begin](const solver::Simulation& s) {
    if (s.state().time < 0.99 * begin) {
      EXPECT_EQ(s.state().particles_at_rest, static_cast<std::int64_t>(s.particle_count()));
    }
  });
  EXPECT_DOUBLE_EQ(simulation.next_event(), begin);
  run_to(simulation, 1.5 * begin,
         [](const solver::Simulation& s) { EXPECT_EQ(s.state().particles_at_rest, 0); });
  const solver::Totals& now = simulation.totals();
  EXPECT_NEAR(now.momentum[2], 0.5 * begin * g * now.mass, 1e-9 * now.momentum[2]);
}

// In one step a thin plate is pushed across the remaining gap to elements, which only impulses stop.
TEST(Contact, IsExactWhereImpulsesMeetFieldsThatPress) {
  Problem problem = impact({}, {.friction = 0.3, .method = "auto"});
  const std::string material = aluminium("contact_aluminium", "0.3 GPa");
  problem.bodies = {
      {"striker", material, box({-3e-3, -3e-3, -3.05e-3}, {3e-3, 3e-3, -0.05e-3}), {300, 0, 4000}},
      {"plate", material, box({-5e-3, -5e-3, 0}, {5e-3, 5e-3, 1e-3}), Vector3::Zero()},
      {"elements", material, box({-5e-3, -5e-3, 1.1e-3}, {5e-3, 5e-3, 4.1e-3}), Vector3::Zero(),
       "discretization = { method = \"finite_elements\" }\n"}};
  solver::Simulation simulation(problem.read(), parallel::world());
  EnergyWatch watch;
  while (simulation.state().time < 0.6e-6) {
    simulation.advance(0.6e-6);
    watch(simulation);
  }
  EXPECT_LT(watch.worst, 1e-13);
  EXPECT_LT(simulation.state().ledger.momentum_error(simulation.totals()), 1e-12);
  EXPECT_GT(simulation.state().ledger.contact_impulse,
            0.002 * simulation.state().ledger.initial.momentum_scale);
}

// One body is one with its image at the plane, the other meets its own: the plane holds the components of the motion of
// the first that contact with the second would give it (4.12). In the edge of two planes all images have one beta.
TEST(Contact, IsExactWhereABodyArrivesAtAPlaneOnWhichAnotherStands) {
  for (const std::string wall : {"symmetry", "no_slip"}) {
    for (const std::string method : {"auto", "multi_field"}) {
      Problem problem;
      problem.end = 1.6e-6;
      problem.domain =
          "[domain]\nlower = [0, 0, 0]\nupper = [0.010, 0.008, 0.006]\ncell_size = 0.001\nboundary = { "
          "x_lower = "
          "\"separating\", y_lower = \"" +
          wall + "\" }\n";
      problem.contact = ContactOptions{.friction = 0.3, .method = method}.toml();
      const std::string material = aluminium("contact_aluminium", "0.3 GPa");
      problem.bodies = {
          {"standing", material, box({0.3e-3, 0, 1e-3}, {2.3e-3, 3e-3, 5e-3}), {-600, 0, 0}},
          {"arriving", material, box({2.7e-3, 0.6e-3, 1e-3}, {4.7e-3, 3.6e-3, 5e-3}), {-1800, -900, 0}}};
      solver::Simulation simulation(problem.read(), parallel::world());
      EnergyWatch watch;
      run_to(simulation, problem.end, [&](const solver::Simulation& s) { watch(s); });
      const solver::Ledger& ledger = simulation.state().ledger;
      EXPECT_LT(watch.worst, 1e-13) << wall << " " << method;
      EXPECT_LT(ledger.momentum_error(simulation.totals()), 1e-12);
      EXPECT_GT(ledger.contact_impulse, 0.01 * ledger.initial.momentum_scale);
      EXPECT_GT(ledger.wall_impulse[1], 0.01 * ledger.initial.momentum_scale);
    }
  }
}

TEST(Contact, KeepsMomentumAndEnergyInEveryMethod) {
  const auto check = [](const Method& method, const ContactOptions& contact, bool exact_energy) {
    solver::Simulation simulation(impact(method, contact).read(), parallel::world());
    for (int step = 0; step < 40; ++step) simulation.advance(2e-6);  // the first touch begins with small ones
    const solver::Ledger& ledger = simulation.state().ledger;
    const std::string what = contact.method + " " + method.scheme + " " + method.shape_function + " " +
                             method.particle_update + " " + contact.normal;
    EXPECT_LT(ledger.momentum_error(simulation.totals()), 1e-12) << what;
    if (exact_energy) {
      EXPECT_LT(std::abs(ledger.energy_error(simulation.totals())), 1e-12) << what;
    }
    EXPECT_GT(ledger.contact_impulse, 0.002 * ledger.initial.momentum_scale) << what;
    EXPECT_GT(ledger.contact_heat, 0.0) << what;
    EXPECT_EQ(ledger.friction_heat > 0.0, contact.friction > 0.0) << what;
  };
  for (const char* normal : {"collinear", "separating", "logistic_regression"}) {
    for (const char* method : {"auto", "multi_field"}) {
      check({}, {.normal = normal, .friction = 0.3, .method = method}, true);
    }
  }
  check({}, {.more = "gap_test = false\n"}, true);
  check({}, {.friction = 0.3, .more = "everywhere = true\n"}, true);
  check({.shape_function = "cubic_bspline", .particle_update = "apic"}, {.friction = 0.3}, true);
  check({.shape_function = "cubic_bspline"}, {.friction = 0.3, .method = "multi_field"}, true);
  for (const char* shape : {"linear", "gimp", "convected_gimp"}) {
    check({.shape_function = shape, .particle_update = "flip"}, {.friction = 0.3}, true);
  }
  for (const char* scheme : {"musl", "usl", "usf"}) {
    check({.scheme = scheme, .shape_function = "gimp", .particle_update = "blend", .courant = 0.3},
          {.friction = 0.3}, false);
  }
}

class ContactMethod : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Contact, ContactMethod, ::testing::Values("auto", "multi_field"));

// One step of the same bodies in another frame, contact and friction included.
TEST_P(ContactMethod, IsGalileanInvariant) {
  constexpr double dt = 20e-9;
  const ContactOptions contact{.friction = 0.3, .more = "gap = 0.5\n", .method = GetParam()};
  const Vector3 boost(-3700.0, 1900.0, 800.0);
  const auto stepped = [&](const Vector3& frame) {
    solver::Simulation simulation(impact({.first_step = 1.0}, contact, frame).read(), parallel::world());
    simulation.advance(dt);
    EXPECT_EQ(simulation.state().time, dt);
    return simulation;
  };
  const solver::Simulation rest = stepped(Vector3::Zero()), moving = stepped(boost);
  EXPECT_GT(rest.state().ledger.friction_heat, 0.0);
  EXPECT_NEAR(moving.state().ledger.friction_heat, rest.state().ledger.friction_heat,
              1e-9 * rest.state().ledger.friction_heat);
  EXPECT_NEAR(moving.state().ledger.contact_heat, rest.state().ledger.contact_heat,
              1e-9 * rest.state().ledger.contact_heat);
  const Particles &a = rest.particles(), &b = moving.particles();
  for (std::size_t p = 0; p < a.size(); ++p) {
    EXPECT_LT((b.velocity[p] - boost - a.velocity[p]).norm(), 1e-8);
    EXPECT_NEAR(b.specific_internal_energy[p], a.specific_internal_energy[p], 1e-3);
  }
}

// Half of the bodies with a mirror plane through the contact equals both halves.
TEST_P(ContactMethod, AMirrorPlaneEqualsRealImages) {
  for (const char* normal : {"collinear", "separating", "logistic_regression"}) {
    const auto run = [&](bool half) {
      Problem problem;
      problem.end = 2e-6;
      problem.domain = std::string("[domain]\nlower = [") + (half ? "0" : "-0.009") +
                       ", -0.008, -0.009]\nupper = [0.009, 0.008, 0.006]\ncell_size = 0.001\n" +
                       (half ? "boundary = { x_lower = \"symmetry\" }\n" : "");
      problem.contact = ContactOptions{.normal = normal, .friction = 0.2, .method = GetParam()}.toml();
      const std::string material = aluminium("contact_aluminium", "0.3 GPa");
      problem.bodies = {{"sphere", material, sphere({0, 0.2e-3, -3.2e-3}, 3.1e-3), {0, 500, 3000}},
                        {"plate", material, box({-5e-3, -5e-3, 0}, {5e-3, 5e-3, 2e-3})}};
      solver::Simulation simulation(problem.read(), parallel::world());
      for (int step = 0; step < 20; ++step) simulation.advance(1e-5);
      return std::pair(simulation.totals(), simulation.state().ledger);
    };
    const auto [half, half_ledger] = run(true);
    const auto [full, full_ledger] = run(false);
    EXPECT_NEAR(2 * half.kinetic_energy, full.kinetic_energy, 1e-10 * full.energy()) << normal;
    EXPECT_NEAR(2 * half_ledger.contact_heat, full_ledger.contact_heat, 1e-9 * full_ledger.contact_heat)
        << normal;
    EXPECT_NEAR(2 * half_ledger.friction_heat, full_ledger.friction_heat, 1e-9 * full_ledger.friction_heat)
        << normal;
    EXPECT_NEAR(2 * half_ledger.contact_impulse, full_ledger.contact_impulse,
                1e-9 * full_ledger.contact_impulse);
    EXPECT_LT(half_ledger.momentum_error(half), 1e-12);
    EXPECT_LT(std::abs(half_ledger.energy_error(half)), 1e-12);
  }
}

TEST(Contact, DoesNotDependOnTheNumberOfThreads) {
  const auto run = [](int threads) {
    parallel::set_threads(threads);
    solver::Simulation simulation(impact({}, {.normal = "logistic_regression", .friction = 0.3}).read(),
                                  parallel::world());
    for (int step = 0; step < 15; ++step) simulation.advance(2e-6);
    parallel::set_threads(1);
    return simulation.totals();
  };
  const solver::Totals one = run(1), three = run(3);
  EXPECT_EQ(one.kinetic_energy, three.kinetic_energy);
  EXPECT_EQ(one.internal_energy, three.internal_energy);
  EXPECT_EQ(one.momentum, three.momentum);
}

/// Two blocks with a gap of 1.5 cells approach: each reaches the nodes of the other long before they touch.
TEST(Contact, BodiesDoNotFeelOneAnotherBeforeTheyTouch) {
  constexpr double dx = 1e-3, speed = 200.0, gap = 1.5e-3;
  const auto run = [&](const std::string& contact,
                       const std::function<void(const solver::Simulation&)>& look) {
    Problem problem;
    problem.end = 5e-6;
    problem.domain = "[domain]\nlower = [-0.012, 0, 0]\nupper = " + vector3({0.012, dx, dx}) +
                     "\ncell_size = 0.001\n" + column_sides;
    problem.contact = contact;
    problem.bodies = {{"left", elastic_aluminium(), box({-8e-3, 0, 0}, {0, dx, dx}), {speed, 0, 0}},
                      {"right", elastic_aluminium(), box({gap, 0, 0}, {8e-3, dx, dx}), {-speed, 0, 0}}};
    solver::Simulation simulation(problem.read(), parallel::world());
    run_to(simulation, 4.5e-6, look);
  };
  double first_touch = 0;
  run(ContactOptions{}.toml(), [&](const solver::Simulation& s) {
    const double before = s.state().time - s.state().time_step;
    if (2 * speed * s.state().time < gap * (1 - 1e-9)) {
      EXPECT_EQ(s.state().ledger.contact_impulse, 0.0) << s.state().time;
    }
    if (2 * speed * before > gap * (1 + 1e-9)) {
      EXPECT_GT(s.state().ledger.contact_impulse, 0.0);
    }
    if (first_touch == 0 && s.state().ledger.contact_impulse > 0) first_touch = s.state().time;
  });
  EXPECT_NEAR(first_touch, gap / (2 * speed), 0.12e-6);  // within a step
  double early = 0;
  run(ContactOptions{.more = "gap_test = false\n"}.toml(), [&](const solver::Simulation& s) {
    if (early == 0 && s.state().ledger.contact_impulse > 0) early = s.state().time;
  });
  EXPECT_LT(early, 0.2 * gap / (2 * speed));
}

// Bodies far apart have bitwise equal results with and without separate velocity fields; there and where they meet, it
// makes no difference whether only the shared nodes have several fields.
TEST(Contact, FieldsElsewhereChangeNothing) {
  const auto run = [](const std::string& contact, double distance, int steps) {
    Problem problem = impact({}, {});
    problem.contact = contact;
    problem.bodies.pop_back();
    problem.bodies[0].shape = sphere({0.1e-3, 0.2e-3, -3.2e-3 - distance}, 3.1e-3);
    solver::Simulation simulation(problem.read(), parallel::world());
    for (int step = 0; step < steps; ++step) simulation.advance(2e-6);
    return simulation.totals();
  };
  const auto expect_same = [](const solver::Totals& a, const solver::Totals& b) {
    EXPECT_EQ(a.kinetic_energy, b.kinetic_energy);
    EXPECT_EQ(a.internal_energy, b.internal_energy);
    EXPECT_EQ(a.momentum, b.momentum);
  };
  const ContactOptions contact{.friction = 0.2}, everywhere{.friction = 0.2, .more = "everywhere = true\n"};
  expect_same(run(contact.toml(), 3.2e-3, 3), run("", 3.2e-3, 3));
  expect_same(run(contact.toml(), 0.0, 25), run(everywhere.toml(), 0.0, 25));
}

}  // namespace
}  // namespace whipple::verification

// SPDX-License-Identifier: BSD-3-Clause
// Bars: frequency of a rod with order of convergence, pendulum-like large rotation, plasticity, breaking;
// energy and momentum to round-off throughout.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "src/core/base/error.hpp"
#include "src/fem/bars.hpp"

namespace whipple::fem_test {
namespace {

using fem::Bars;
using std::numbers::pi;

fem::Lines straight(std::size_t n, double length) {
  fem::Lines lines;
  for (std::size_t i = 0; i <= n; ++i)
    lines.nodes.emplace_back(length * static_cast<double>(i) / static_cast<double>(n), 0, 0);
  for (std::uint32_t i = 0; i < n; ++i) lines.add({i, i + 1});
  return lines;
}

fem::BarMaterial steel() { return {.density = 7800.0, .young = 200e9}; }

struct Sums {
  Vector3 momentum = Vector3::Zero(), angular_momentum = Vector3::Zero();
  double energy = 0.0;
};
Sums sums(const Bars& bars) {
  Sums s;
  s.energy = fem::internal_energy(bars);
  for (std::size_t a = 0; a < bars.nodes.size(); ++a) {
    const Vector3 p = bars.nodes.mass[a] * bars.nodes.velocity[a];
    s.momentum += p;
    s.angular_momentum += bars.nodes.position[a].cross(p);
    s.energy += 0.5 * p.dot(bars.nodes.velocity[a]);
  }
  return s;
}

fem::ConstraintBalance step(Bars& bars, double dt) {
  fem::Motion motion;
  fem::internal_forces(bars);
  const fem::ConstraintBalance balance = fem::advance_velocities(bars.nodes, dt, motion);
  fem::deform(bars, motion, dt);
  fem::move_nodes(bars.nodes, motion, dt);
  return balance;
}

/// Free rod, first longitudinal mode: the discrete frequency of lumped masses is known in closed form, and
/// tends to c pi / L with second order.
TEST(Bars, RodFrequencyConverges) {
  double before = 0.0;
  for (const std::size_t n : {8, 16, 32}) {
    constexpr double length = 0.1;
    Bars bars = fem::make_bars(straight(n, length), 1e-4, steel(), "rod");
    for (std::size_t a = 0; a <= n; ++a)
      bars.nodes.velocity[a][0] = 1e-3 * std::cos(pi * bars.nodes.position[a][0] / length);
    const double exact = length / std::sqrt(200e9 / 7800.0);  // half a period
    const double dt = 0.1 * fem::critical_time_step(bars);
    const double start = bars.nodes.position[0][0];
    double time = 0.0, moved = 0.0, last = 0.0;
    do {
      step(bars, dt);
      time += dt;
      last = moved;
      moved = bars.nodes.position[0][0] - start;
    } while (time < 0.5 * exact || moved > 0.0);
    const double error = exact / (time - dt * moved / (moved - last)) - 1.0;
    const double h =
        pi / (2.0 * static_cast<double>(n));  // discrete in space and time: sin(w dt/2) = 0.1 sin(h)
    EXPECT_NEAR(error, std::asin(0.1 * std::sin(h)) / (0.1 * h) - 1.0, 1e-6);
    if (before != 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.1);
    }
    before = error;
  }
}

TEST(Bars, EnergyMomentumAngularMomentumOfATumblingFrame) {
  fem::Lines tetrahedron;
  tetrahedron.nodes = {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)};
  for (const auto& ends : {std::array{0U, 1U}, {0U, 2U}, {0U, 3U}, {1U, 2U}, {2U, 3U}, {3U, 1U}})
    tetrahedron.add(ends);
  fem::BarMaterial material = steel();
  material.yield_stress = 400e6;
  material.hardening_modulus = 2e9;
  material.failure_strain = 0.02;
  Bars bars = fem::make_bars(tetrahedron, 1e-4, material, "frame");
  std::mt19937_64 generator(4);
  std::uniform_real_distribution<double> uniform(-60.0, 60.0);
  for (Vector3& v : bars.nodes.velocity)
    v = Vector3(uniform(generator), uniform(generator), 500.0 + uniform(generator));
  const Sums start = sums(bars);
  const double dt = 0.5 * fem::critical_time_step(bars);
  for (int i = 0; i < 500; ++i) step(bars, dt);
  const Sums end = sums(bars);
  EXPECT_NEAR(end.energy, start.energy, 1e-13 * start.energy);
  EXPECT_LT((end.momentum - start.momentum).norm(), 1e-13 * start.momentum.norm());
  EXPECT_LT((end.angular_momentum - start.angular_momentum).norm(), 1e-12 * start.angular_momentum.norm());
  EXPECT_GT(std::ranges::count(bars.elements.broken, 1), 0);  // some break, and nothing is lost
  EXPECT_LT(std::ranges::count(bars.elements.broken, 1), 6);
}

/// A whole turn in large steps leaves no stress: the strain is that of the length.
TEST(Bars, RotationIsFreeOfStress) {
  Bars bars = fem::make_bars(straight(1, 1.0), 1e-4, steel(), "bar");
  fem::Motion motion;
  motion.mean.assign(2, Vector3::Zero());
  motion.end.assign(2, Vector3::Zero());
  for (int i = 1; i <= 12; ++i) {
    const double angle = 2.0 * pi * i / 12.0;
    motion.end[1] = Vector3(std::cos(angle), std::sin(angle), 0) - bars.nodes.position[1];
    fem::deform(bars, motion, 1.0);
    fem::move_nodes(bars.nodes, motion, 1.0);
    EXPECT_LT(std::abs(bars.elements.stress[0]), 1e-14 * 200e9);
  }
}

/// Pulled apart at constant speed: yield, hardening and unloading of the closed solution; the work of the
/// ends is the internal energy; beyond the failure strain the bar is broken and its force is gone.
TEST(Bars, PlasticityHasItsClosedForm) {
  fem::BarMaterial material = steel();
  material.yield_stress = 400e6;
  material.hardening_modulus = 1e9;
  material.failure_strain = 0.1;
  Bars bars = fem::make_bars(straight(1, 1.0), 1e-4, material, "bar");
  constrain(bars.nodes, std::vector<std::uint32_t>{0}, fem::constraint::all);
  constrain(bars.nodes, std::vector<std::uint32_t>{1}, fem::constraint::all, Vector3(1.0, 0, 0));
  bars.nodes.velocity[1] = Vector3(1.0, 0, 0);
  double work = 0.0;
  const auto stretch_to = [&](double length, double speed) {
    constrain(bars.nodes, std::vector<std::uint32_t>{1}, fem::constraint::all, Vector3(speed, 0, 0));
    bars.nodes.velocity[1] = Vector3(speed, 0, 0);
    const int steps = 10000;
    const double dt = (length - bars.nodes.position[1][0]) / speed / steps;
    for (int i = 0; i < steps; ++i) work += step(bars, dt).work;
  };
  stretch_to(1.05, 1.0);
  const double strain = std::log(1.05);
  const double plastic = (200e9 * strain - 400e6) / (200e9 + 1e9);
  EXPECT_NEAR(bars.elements.plastic_strain[0], plastic, 1e-12);
  EXPECT_NEAR(bars.elements.stress[0], 400e6 + 1e9 * plastic, 1.0);
  EXPECT_NEAR(fem::internal_energy(bars), work, 1e-12 * work);
  // Closed form of the work: elastic, then along the yield stress; an explicit sum of 10,000 steps.
  const double volume = 1e-4, stress = bars.elements.stress[0];
  EXPECT_NEAR(work, volume * (0.5 * stress * stress / 200e9 + 400e6 * plastic + 0.5e9 * plastic * plastic),
              2e-4 * work);
  stretch_to(1.05 * std::exp(-0.5 * stress / 200e9), -1.0);  // half unloaded, elastically
  EXPECT_NEAR(bars.elements.stress[0], 0.5 * stress, 1.0);
  stretch_to(1.2, 1.0);
  EXPECT_EQ(bars.elements.broken[0], 1);
  fem::internal_forces(bars);
  EXPECT_EQ(bars.nodes.force[1].norm(), 0.0);
  EXPECT_NEAR(fem::internal_energy(bars), work, 1e-12 * work);
}

TEST(Bars, AHoopBreathesWithItsFrequencyAndEndsWhereItsPlasticWorkIsDone) {
  // omega = c/R; rigid-plastic: rho v^2/2 = Y ln(R/R0) + Y^2/(2 E). A row of three is three times as heavy.
  const double radius = 0.1, speed = 100.0, area = 1e-4;
  fem::BarMaterial material = steel();
  for (const double yield : {std::numeric_limits<double>::infinity(), 250e6}) {
    material.yield_stress = yield;
    fem::Lines lines;
    lines.nodes.emplace_back(0.3, radius, 0.0);
    lines.add({0, 0}, 3.0);
    Bars bars = fem::make_bars(lines, area, material, "hoop");
    const double mass = 3.0 * material.density * area * 2.0 * pi * radius;
    EXPECT_NEAR(bars.nodes.mass[0], mass, 1e-14 * mass);
    bars.nodes.velocity[0] = Vector3(7.0, std::isinf(yield) ? 0.1 : speed, 0.0);
    const double start = 0.5 * mass * bars.nodes.velocity[0].squaredNorm();
    fem::Motion motion;
    const double dt = 0.02 * fem::critical_time_step(bars);
    double time = 0.0, before = bars.nodes.velocity[0][1], turned = 0.0;
    while (turned == 0.0 && time < 1.0) {
      fem::internal_forces(bars);
      EXPECT_EQ(bars.nodes.force[0][0], 0.0);
      fem::advance_velocities(bars.nodes, dt, motion);
      fem::deform(bars, motion, dt);
      fem::move_nodes(bars.nodes, motion, dt);
      const double now = bars.nodes.velocity[0][1];
      if (now < 0.0) turned = time + dt * before / (before - now);
      before = now;
      time += dt;
    }
    const double energy = 0.5 * mass * bars.nodes.velocity[0].squaredNorm() + fem::internal_energy(bars);
    EXPECT_NEAR(energy, start, 1e-13 * start);
    const double c = std::sqrt(material.young / material.density);
    if (std::isinf(yield)) {
      EXPECT_NEAR(turned, 0.5 * pi * radius / c, 0.01 * turned);
    } else {
      const double strain = 0.5 * material.density * speed * speed / yield + 0.5 * yield / material.young;
      EXPECT_NEAR(std::log(bars.nodes.position[0][1] / radius), strain, 2e-3 * strain);
    }
  }
}

TEST(Bars, BadInput) {
  const auto message = [](const fem::Lines& lines, double area, const fem::BarMaterial& material) {
    try {
      fem::make_bars(lines, area, material, "rebar");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  using ::testing::HasSubstr;
  const fem::Lines good = straight(3, 1.0);
  EXPECT_EQ(message(good, 1e-4, steel()), "no error");
  EXPECT_THAT(message({}, 1e-4, steel()), HasSubstr("rebar: there are no bars"));
  EXPECT_THAT(message(good, 0.0, steel()), HasSubstr("the cross-section of bars must be positive, not 0"));
  EXPECT_THAT(message(good, 1e-4, {.density = 7800.0}), HasSubstr("Young's modulus"));
  fem::Lines bad = good;
  bad.elements[1] = {2, 2};
  EXPECT_THAT(message(bad, 1e-4, steel()), HasSubstr("bar 1 has no length"));
  bad.elements[1] = {2, 9};
  EXPECT_THAT(message(bad, 1e-4, steel()), HasSubstr("bar 1: node 9 does not exist, there are 4"));
  bad = good;
  bad.nodes.emplace_back(3, 3, 3);
  EXPECT_THAT(message(bad, 1e-4, steel()), HasSubstr("node 4 belongs to no bar"));
}

}  // namespace
}  // namespace whipple::fem_test

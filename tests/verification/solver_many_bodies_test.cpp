// SPDX-License-Identifier: BSD-3-Clause
// More than 64 velocity fields: what a body does does not depend on its number, and balances are exact in a heap of 80.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/verification/contact_problems.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification::many_bodies {
namespace {

constexpr double cell = 1e-3;

/// Keeps the largest errors of energy and momentum.
struct Balance {
  double energy = 0.0, momentum = 0.0;
  void operator()(const solver::Simulation& s) {
    energy = std::max(energy, std::abs(s.state().ledger.energy_error(s.totals())));
    momentum = std::max(momentum, s.state().ledger.momentum_error(s.totals()));
  }
  void expect_exact() const {
    EXPECT_LT(energy, 1e-13);
    EXPECT_LT(momentum, 1e-13);
  }
};

std::string block(std::size_t number, const Vector3& lower, const Vector3& velocity, double cells = 2.0) {
  static const std::string material = elastic_aluminium();
  return BodyOptions{"b" + std::to_string(number), material,
                     box(lower + Vector3(0, 0, -1), lower + Vector3(cells * cell, cells * cell, 1.0)),
                     velocity}
      .toml();
}

/// Returns two blocks that meet obliquely, and blocks at rest in a row far from them.
/// @param before  number of blocks at rest in front of the two in the list of bodies
cases::Case two_that_meet(std::size_t before, std::size_t all) {
  std::string text =
      Method{}.time_toml(2e-6) + Method{}.toml() +
      "[contact]\nmethod = \"multi_field\"\nfriction = 0.2\n[domain]\n"
      "dimension = \"plane_strain\"\nlower = [0, 0]\nupper = [0.32, 0.02]\ncell_size = 0.001\n";
  for (std::size_t n = 0; n < all; ++n) {
    if (n == before) {
      text += block(1000, {3e-3, 3e-3, 0.0}, {400, 60, 0}) + block(1001, {5.2e-3, 4e-3, 0.0}, {-300, 0, 0});
    }
    text += block(n, {20e-3 + 4.0 * cell * static_cast<double>(n), 12e-3, 0.0}, Vector3::Zero());
  }
  return cases::read_case_text(text, "many.toml");
}

TEST(ManyBodies, TheNumberOfABodyDoesNotMatter) {
  constexpr std::size_t all = 70;
  std::vector<std::vector<Vector3>> velocities;
  for (const std::size_t before : {std::size_t{0}, std::size_t{63}, std::size_t{68}}) {
    solver::Simulation simulation(two_that_meet(before, all), parallel::world());
    Balance balance;
    run_to(simulation, 2e-6, [&](const solver::Simulation& s) { balance(s); });
    balance.expect_exact();
    EXPECT_GT(simulation.state().ledger.contact_impulse, 0.0);
    EXPECT_GT(simulation.state().ledger.friction_heat, 0.0);
    velocities.emplace_back();
    const Particles& q = simulation.particles();
    for (std::size_t p = 0; p < q.size(); ++p) {
      if (q.body[p] == before || q.body[p] == before + 1) velocities.back().push_back(q.velocity[p]);
    }
  }
  ASSERT_EQ(velocities[0].size(), velocities[2].size());
  for (std::size_t p = 0; p < velocities[0].size(); ++p) {
    EXPECT_LT((velocities[1][p] - velocities[0][p]).norm(), 1e-9) << p;  // m/s
    EXPECT_LT((velocities[2][p] - velocities[0][p]).norm(), 1e-9) << p;
  }
}

TEST(ManyBodies, EightyInAHeapKeepEnergyAndMomentum) {
  std::string text =
      Method{}.time_toml(2e-6) + Method{}.toml() +
      "[contact]\nmethod = \"multi_field\"\nfriction = 0.2\n[domain]\n"
      "dimension = \"plane_strain\"\nlower = [0, 0]\nupper = [0.048, 0.04]\ncell_size = 0.001\n"
      "boundary = { x_lower = \"separating\", y_lower = \"separating\" }\n";
  for (std::size_t n = 0; n < 80; ++n) {
    const Vector3 lower(1.2e-3 + 4.2e-3 * static_cast<double>(n % 10),
                        1.1e-3 + 4.2e-3 * static_cast<double>(n / 10), 0.0);
    text += block(n, lower,
                  {-200.0 - 40.0 * static_cast<double>(n % 7), -300.0 + 50.0 * static_cast<double>(n % 5), 0},
                  4.0);
  }
  solver::Simulation simulation(cases::read_case_text(text, "heap.toml"), parallel::world());
  Balance balance;
  run_to(simulation, 2e-6, [&](const solver::Simulation& s) { balance(s); });
  balance.expect_exact();
  const solver::Ledger& ledger = simulation.state().ledger;
  EXPECT_GT(ledger.contact_impulse, 0.01 * ledger.initial.momentum_scale);
  EXPECT_GT(ledger.friction_heat, 0.0);
}

}  // namespace
}  // namespace whipple::verification::many_bodies

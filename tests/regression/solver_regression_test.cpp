// SPDX-License-Identifier: BSD-3-Clause
// Detects unintended changes: sums of the main case on cells of 1 mm at 3 us, as printed by
//   whipple run cases/copper_disk_on_aluminium/case.toml --set domain.cell_size='1 mm' --set time.end='3 us'
// in the last row of history.csv. No proof of correctness: a deliberate change of method or material renews
// them.
#include <gtest/gtest.h>

#include <utility>

#include "src/core/base/simd.hpp"
#include "tests/folders.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

TEST(Regression, DebrisCloudKeepsItsSums) {
  const cases::Case setup =
      cases::read_case(whipple::tests::source_folder() + "/cases/copper_disk_on_aluminium/case.toml",
                       {{"domain.cell_size", "1 mm"}, {"time.end", "3 us"}});
  solver::Simulation simulation(setup, parallel::world());
  run_to(simulation, setup.time.end);
  // Round-off grows in a cloud of failed particles and differs between compilers; changes of the physics exceed this.
  constexpr double tolerance = 1e-3;
  const auto expect = [&](double value, double stored) { EXPECT_NEAR(value, stored, tolerance * stored); };
  const solver::Totals& totals = simulation.totals();
  const solver::Ledger& ledger = simulation.state().ledger;
  expect(totals.kinetic_energy, 9958.481397611564);
  expect(totals.internal_energy, 418.80472705453315);
  expect(ledger.transfer_heat, 40.754961280288576);
  expect(ledger.wall_impulse[0], 0.7766558424112606);
  EXPECT_EQ(simulation.state().step, 101);
}

/// Compares steps of a case with either device. Differences are relative to the largest value of each field; those of
/// earlier steps accumulate.
void expect_the_same_steps(const char* name,
                           const std::vector<std::pair<std::string, std::string>>& overrides, int steps) {
  const cases::Case setup =
      cases::read_case(whipple::tests::source_folder() + "/cases/" + name + "/case.toml", overrides);
  const auto after_steps = [&](KernelSet set) {
    const KernelSet in_use = std::exchange(kernel_set(), set);
    solver::Simulation simulation(setup, parallel::world());
    for (int n = 0; n < steps; ++n) simulation.advance(setup.time.end);
    kernel_set() = in_use;
    return simulation.particles();
  };
  const Particles fast = after_steps(kernel_set()), plain = after_steps(KernelSet::plain);
  ASSERT_EQ(fast.id, plain.id);
  const auto expect = [&](const char* field, auto&& value) {
    double largest = 0.0, difference = 0.0;
    for (std::size_t p = 0; p < fast.size(); ++p) {
      largest = std::max(largest, std::abs(value(fast, p)));
      difference = std::max(difference, std::abs(value(fast, p) - value(plain, p)));
    }
    EXPECT_GT(largest, 0.0) << name << ", " << field;
    EXPECT_LE(difference, 1e-13 * steps * largest) << name << ", " << field;
  };
  expect("position", [](const Particles& q, std::size_t p) { return q.position[p].sum(); });
  expect("velocity", [](const Particles& q, std::size_t p) { return q.velocity[p].sum(); });
  expect("affine velocity", [](const Particles& q, std::size_t p) { return q.affine_velocity[p].sum(); });
  expect("energy", [](const Particles& q, std::size_t p) { return q.specific_internal_energy[p]; });
  expect("pressure", [](const Particles& q, std::size_t p) { return q.pressure[p]; });
  expect("stress", [](const Particles& q, std::size_t p) { return q.deviatoric_stress[p].matrix().sum(); });
  expect("plastic strain", [](const Particles& q, std::size_t p) { return q.plastic_strain[p]; });
}

TEST(ReferenceDevice, GivesTheSameStepsWithEquationsOfStateAndStrength) {
  expect_the_same_steps("copper_disk_on_aluminium", {{"domain.cell_size", "1 mm"}},
                        10);  // GRAY, contact, conduction
  expect_the_same_steps(
      "copper_disk_on_aluminium",
      {{"domain.cell_size", "0.8 mm"}, {"domain.dimension", "axisymmetric"}, {"domain.axis", "z"}}, 10);
  expect_the_same_steps("taylor_bar", {{"domain.cell_size", "1.52 mm"}}, 10);  // Mie-Grueneisen, von Mises
  expect_the_same_steps(
      "taylor_bar", {{"domain.cell_size", "1.52 mm"}, {"body.0.material", "copper_johnson_cook.toml"}}, 10);
}

}  // namespace
}  // namespace whipple::verification

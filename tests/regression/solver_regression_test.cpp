// SPDX-License-Identifier: BSD-3-Clause
// Did anything change unintentionally? Sums of the main case on cells of 1 mm at 3 us, as printed by
//   whipple run cases/copper_disk_on_aluminium/case.toml --set domain.cell_size='1 mm' --set time.end='3 us'
// in the last row of history.csv. No proof of correctness: a deliberate change of method or material renews
// them.
#include <gtest/gtest.h>

#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

TEST(Regression, DebrisCloudKeepsItsSums) {
  const cases::Case setup =
      cases::read_case(std::string(WHIPPLE_SOURCE_DIR) + "/cases/copper_disk_on_aluminium/case.toml",
                       {{"domain.cell_size", "1 mm"}, {"time.end", "3 us"}});
  solver::Simulation simulation(setup, parallel::world());
  run_to(simulation, setup.time.end);
  // Round-off grows in a cloud of failed particles, and compilers differ in it; physics would move these by
  // more.
  constexpr double tolerance = 1e-3;
  const auto expect = [&](double value, double stored) { EXPECT_NEAR(value, stored, tolerance * stored); };
  const solver::Totals& totals = simulation.totals();
  const solver::Ledger& ledger = simulation.state().ledger;
  expect(totals.kinetic_energy, 9957.900184688977);
  expect(totals.internal_energy, 413.4542990866006);
  expect(ledger.transfer_heat, 38.248250160373765);
  expect(ledger.wall_impulse[0], 0.7725832768283504);
  EXPECT_EQ(simulation.state().step, 101);
}

}  // namespace
}  // namespace whipple::verification

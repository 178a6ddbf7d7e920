// SPDX-License-Identifier: BSD-3-Clause
// Cracks on several ranks: damage, directions and sides of a node are sums over the contributions of all ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "tests/parallel/solver_ranks.hpp"
#include "tests/verification/crack_problems.hpp"

namespace whipple::solver {
namespace {

/// Checks the sizes of fragments that particles keep, by the sum of all ranks. Collective.
void expect_same_sizes(const Simulation& together, const Simulation& alone) {
  const auto sum = [](const Simulation& simulation) {
    const std::vector<double>& sizes = simulation.particles().history.scalar("fragment_size");
    return std::accumulate(sizes.begin(), sizes.end(), 0.0);
  };
  std::array everywhere = {sum(together)};
  parallel::sum(MPI_COMM_WORLD, everywhere);
  if (!is_root()) return;
  EXPECT_NEAR(everywhere[0], sum(alone), 1e-9 * sum(alone));
}

TEST(CrackRanks, AgreeWithOneRank) {
  for (const char* dimension : {"plane_strain", "3d"}) {
    SCOPED_TRACE(dimension);
    constexpr double end = 1.2e-6;
    const cases::Case setup = verification::breaking_plate(dimension, "fields");
    Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF),
        whole(verification::breaking_plate(dimension, "none"), MPI_COMM_SELF);
    advance_to(together, end);
    advance_on_root(alone, end);
    advance_on_root(whole, end);
    expect_same_sizes(together, alone);
    expect_agreement(together, alone, 1e-9);
    const Totals totals = together.totals();
    EXPECT_LT(together.state().ledger.momentum_error(totals), 1e-12);
    EXPECT_LT(std::abs(together.state().ledger.energy_error(totals)), 1e-12);
    if (!is_root()) continue;
    EXPECT_GT(verification::largest_distance(alone.particles(), whole.particles()), 1e-6);  // cracks open
    EXPECT_TRUE(std::ranges::any_of(alone.particles().failed, [](std::uint8_t code) { return code != 0; }));
    const std::vector<double>& sizes = alone.particles().history.scalar("fragment_size");
    EXPECT_TRUE(std::ranges::any_of(sizes, [](double size) { return size > 0.0; }));
  }
}

}  // namespace
}  // namespace whipple::solver

int main(int argc, char** argv) {
  whipple::parallel::world();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

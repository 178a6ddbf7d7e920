// SPDX-License-Identifier: BSD-3-Clause
// Ten kills of workers and drivers at random moments: the final store is the undisturbed one. Teams of ranks:
// ranks that wait for each other at every step are slow on a busy machine.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/parallel/md_program.hpp"

namespace whipple::md::testing {
namespace {

// Points enough that the kills find the plan at work on a fast and idle machine too.
TEST_F(WhippleMd, SurvivesTenKills) {
  write("plan.toml", std::string(plan_text) + R"(
[[isotherm]]
temperature = "600 K"
volume_ratio = [1.01, 1, 0.995, 0.988, 0.98, 0.973, 0.965, 0.958, 0.95, 0.943, 0.935, 0.927, 0.92, 0.912, 0.905, 0.897, 0.89, 0.883, 0.875, 0.868, 0.86, 0.853, 0.845, 0.838, 0.83, 0.823, 0.815, 0.807]
cells = 3
equilibration_steps = 100
steps = 10000
)");
  kill_at_random(*this, 10);
}

// Two ranks per point: the same bits with one team as with two, and other points than those of one rank each.
TEST_F(WhippleMd, TeamsOfRanksComputeAPointTogether) {
  write("plan.toml", std::string("ranks_per_point = 2\n") + plan_text);
  const Outcome one = run(mpirun(2, command("one.md.h5")));
  ASSERT_EQ(one.code, 0) << one.text;
  const Outcome two = run(mpirun(4, command("two.md.h5")));
  ASSERT_EQ(two.code, 0) << two.text;
  EXPECT_EQ(bytes_of(path("one.md.h5")), bytes_of(path("two.md.h5")));
  write("plan.toml", plan_text);
  ASSERT_EQ(run(command("alone.md.h5")).code, 0);
  const std::vector<PointRecord> together = read_store(path("one.md.h5"));
  const std::vector<PointRecord> alone = read_store(path("alone.md.h5"));
  ASSERT_EQ(together.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_NE(together[i].key, alone[i].key);
    if (alone[i].protocol != "isotherm") continue;
    // Another seed, the same physics: within five standard errors of these short runs.
    const auto found = std::find_if(together.begin(), together.end(), [&](const PointRecord& point) {
      return point.protocol == "isotherm" && point.conditions == alone[i].conditions;
    });
    ASSERT_NE(found, together.end());
    const Estimate a = alone[i].result("pressure"), b = found->result("pressure");
    EXPECT_LT(std::abs(a.value - b.value), 5.0 * std::hypot(a.error, b.error)) << alone[i].label();
  }
}

}  // namespace
}  // namespace whipple::md::testing

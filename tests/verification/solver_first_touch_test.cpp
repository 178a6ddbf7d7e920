// SPDX-License-Identifier: BSD-3-Clause
// A time step ends at the first contact of bodies, and the next one starts small (docs/theory/mpm.md, section 6).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/unit/temporary_folder.hpp"
#include "tests/verification/gap_problems.hpp"
#include "tests/verification/same_state.hpp"

namespace whipple::verification {
namespace {

struct Steps {
  std::vector<double> begin, length;
  explicit Steps(const Problem& problem) {
    solver::Simulation simulation(problem.read(), parallel::world());
    run_to(simulation, problem.end, [&](const solver::Simulation& s) {
      begin.push_back(s.state().time - s.state().time_step);
      length.push_back(s.state().time_step);
    });
  }
  /// Returns the step that contains a time, and the longest one before it.
  [[nodiscard]] std::size_t at(double time) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(begin, time) - begin.begin()) - 1;
  }
  [[nodiscard]] double longest_before(std::size_t step) const {
    return *std::max_element(length.begin(), length.begin() + static_cast<std::ptrdiff_t>(step));
  }
};

/// Requires that the step that contains the contact, or the one that begins there, is a twentieth of those in flight.
void expect_small_step_at(const Steps& steps, double touch) {
  const std::size_t last = steps.at(touch * (1.0 + 1e-9));
  const double full = steps.longest_before(last);
  std::size_t small = last;
  while (small < steps.length.size() && steps.length[small] > 0.06 * full) ++small;
  ASSERT_LT(small, steps.length.size());
  EXPECT_LT(std::abs(steps.begin[small] - touch), 0.15 * full) << "the small step begins at the touch";
  EXPECT_GT(steps.length[small], 0.04 * full);
  EXPECT_NEAR(steps.length[small + 1], 1.05 * steps.length[small], 1e-3 * steps.length[small]);
}

TEST(FirstTouch, StepOfBodiesLandsOnIt) {
  for (const double speed : {1000.0, 6000.0}) {
    const PlanarGap set{.speed = speed, .gap = 6.3};
    expect_small_step_at(Steps(set.problem()), set.touch());
  }
}

TEST(FirstTouch, SlowBodiesKeepTheirStep) {
  const PlanarGap set{.speed = 20.0, .gap = 0.2, .after = 0.1e-6};
  const Steps steps(set.problem());
  const std::size_t touch = steps.at(set.touch());
  EXPECT_GT(touch, 65U);
  EXPECT_GT(steps.length[touch + 1], 0.9 * steps.longest_before(touch));
}

// In flight, in the step of the contact, and after it
TEST(FirstTouch, RestartsBitwiseTheSame) {
  const PlanarGap set{.speed = 3000.0, .gap = 6.3, .after = 0.05e-6};
  const cases::Case setup = set.problem().read();
  solver::Simulation simulation(setup, parallel::world());
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> checkpoints;
  run_to(simulation, set.problem().end, [&](const solver::Simulation& s) {
    const double left = (set.touch() - s.state().time) / s.state().time_step;
    if (s.state().step == 20 || std::abs(left) < 1.2)
      checkpoints.push_back(save(s, folder.path() / std::to_string(s.state().step)));
  });
  ASSERT_GT(checkpoints.size(), 2U);
  for (const std::filesystem::path& checkpoint : checkpoints) {
    solver::Simulation restarted = restored(setup, checkpoint, parallel::world());
    run_to(restarted, set.problem().end);
    EXPECT_EQ(restarted.state().step, simulation.state().step);
    expect_same(simulation, restarted);
  }
}

}  // namespace
}  // namespace whipple::verification

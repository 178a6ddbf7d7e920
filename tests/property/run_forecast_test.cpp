// SPDX-License-Identifier: BSD-3-Clause
// The forecast of `whipple check` against runs: steps inside the range, and the share of material that moves.
#include "src/run/forecast.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "src/core/parallel/mpi.hpp"

namespace whipple::run {
namespace {

cases::Case case_of(const std::string& name, const std::vector<std::pair<std::string, std::string>>& overrides) {
  return cases::read_case(std::string(WHIPPLE_SOURCE_DIR) + "/cases/" + name + "/case.toml", overrides);
}

struct Measured {
  double steps = 0.0, moving = 0.0;  ///< mean share of the particles that were not at rest
};

Measured measured(const cases::Case& setup) {
  solver::Simulation simulation(setup, parallel::world());
  Measured outcome;
  double resting = 0.0;
  while (simulation.state().time < setup.time.end) {
    simulation.advance(setup.time.end);
    outcome.steps += 1.0;
    resting += simulation.state().time_step * static_cast<double>(simulation.state().particles_at_rest);
  }
  outcome.moving = 1.0 - resting / (setup.time.end * static_cast<double>(simulation.particle_count()));
  return outcome;
}

void expect_foreseen(const cases::Case& setup) {
  cases::Case awake = setup;
  awake.transfer.rest_tolerance = 0.0;
  solver::Simulation simulation(awake, parallel::world());
  const Forecast foreseen = forecast(simulation);
  const Measured outcome = measured(setup);
  EXPECT_LE(foreseen.least_steps, outcome.steps);
  EXPECT_GE(foreseen.most_steps, outcome.steps);
  EXPECT_LT(foreseen.most_steps, 2.5 * foreseen.least_steps);
  EXPECT_LT(std::abs(std::log(foreseen.moving_share / outcome.moving)), std::log(1.6));
  EXPECT_GT(foreseen.nanoseconds, 0.0);
  EXPECT_LT(foreseen.least_time, foreseen.most_time);
}

TEST(Forecast, OfAnImpact) {
  expect_foreseen(case_of("copper_disk_on_aluminium", {{"domain.cell_size", "1.2 mm"}}));
}

TEST(Forecast, OfATaylorBar) { expect_foreseen(case_of("taylor_bar", {{"domain.cell_size", "1.52 mm"}})); }

TEST(Forecast, OfACraterInABlockThatRestsAtFirst) {
  expect_foreseen(case_of("prater_6061", {{"domain.cell_size", "3 mm"}, {"time.end", "10 us"}}));
}

TEST(Forecast, OfAProjectileThatFliesFirst) {
  expect_foreseen(case_of("whipple_shield", {{"domain.cell_size", "2.5 mm"}}));
}

}  // namespace
}  // namespace whipple::run

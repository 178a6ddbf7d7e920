// SPDX-License-Identifier: BSD-3-Clause
// The forecast of `whipple check` against runs: steps inside the range, and the share of material that moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/run/forecast.hpp"
#include "tests/folders.hpp"

namespace whipple::run {
namespace {

cases::Case case_of(const std::string& name,
                    const std::vector<std::pair<std::string, std::string>>& overrides) {
  return cases::read_case(whipple::tests::source_folder() + "/cases/" + name + "/case.toml", overrides);
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

TEST(Forecast, OfSectionsWithFewSteps) {
  const std::vector<std::pair<std::string, std::string>> section = {{"domain.dimension", "axisymmetric"}};
  auto lead = section, disk = section;
  lead.insert(lead.end(), {{"domain.axis", "x"}, {"domain.cell_size", "3 mm"}});
  expect_foreseen(case_of("lead_sphere_on_plate_gray", lead));
  disk.insert(disk.end(), {{"domain.axis", "z"}, {"domain.cell_size", "1 mm"}});
  expect_foreseen(case_of("copper_disk_on_aluminium", disk));
}

// The ball meets the plate in the run: steps grow twice from a twentieth of the allowed one.
TEST(Forecast, OfAGapAndManySnapshots) {
  const std::string file = whipple::tests::source_folder() + "/tests/data/small_impact.toml";
  for (const char* every : {"0.5 us", "0.02 us", "0.002 us"}) {
    const cases::Case setup = cases::read_case(file, {{"output.snapshot_every", every}});
    solver::Simulation foreseen(setup, parallel::world()), run(setup, parallel::world());
    const Forecast steps = forecast(foreseen);
    double taken = 0.0, next = setup.output.snapshot_every;
    for (; run.state().time < (1.0 - 1e-9) * setup.time.end; taken += 1.0) {
      if (run.state().time >= (1.0 - 1e-9) * next) next += setup.output.snapshot_every;
      run.advance(std::min(next, setup.time.end));
    }
    EXPECT_LE(steps.least_steps, taken) << every;
    EXPECT_GE(steps.most_steps, taken) << every;
    EXPECT_LT(steps.most_steps, 3.0 * steps.least_steps) << every;  // it is not known whether they will meet
  }
}

}  // namespace
}  // namespace whipple::run

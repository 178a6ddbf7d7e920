// SPDX-License-Identifier: BSD-3-Clause
// Fluid at constant volume: the dilute gas, equality of the two ways to its energy, and a state between melt and vapour.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

const Potential& copper() {
  static const Potential potential = Potential::load("copper_universal_3", "Cu");
  return potential;
}

struct Computed {
  FluidPoint point;
  std::string message;
};

/// Computes the only state of a plan with the given [[fluid]].
Computed fluid(double ratio, double temperature, std::int64_t steps) {
  Plan plan;
  plan.fluids.push_back({.volume_ratio = {ratio},
                         .temperature = {temperature},
                         .size = {.cells = 4, .equilibration_steps = 1000, .steps = steps}});
  for (const Task& task : make_tasks(plan, copper())) {
    if (task.protocol != FluidPoint::protocol) continue;
    const TaskResult result = task.compute(nullptr);
    PointRecord record;
    record.protocol = task.protocol;
    record.status = PointStatus::done;
    record.conditions = task.conditions;
    record.results = result.results;
    return {select_as<FluidPoint>(std::vector{record}).at(0), result.message};
  }
  throw std::runtime_error("no task");
}

TEST(Fluid, ThinAndHotIsAnIdealGas) {
  const double T = 60000, ratio = 28;
  const auto [p, message] = fluid(ratio, T, 2000);
  const double ideal = 8.314463 / 0.063546 * T / (ratio * copper().static_volume());
  EXPECT_TRUE(p.uniform) << message << " " << p.density_wave;
  EXPECT_NEAR(p.pressure.value, ideal, 0.06 * ideal);  // the second virial coefficient makes 4 %
  EXPECT_NEAR(p.density_wave, 1.0 / 256, 0.5 / 256);   // of atoms at random
}

// (dE/dV)_T = T (dP/dT)_V - P of one free energy, by differences over a supercritical state.
TEST(Fluid, EnergyAndPressureAreOfOneFreeEnergy) {
  const double V = copper().static_volume();
  const FluidPoint cold = fluid(1.5, 8000, 2500).point, hot = fluid(1.5, 12000, 2500).point;
  const FluidPoint dense = fluid(1.35, 10000, 2500).point, thin = fluid(1.65, 10000, 2500).point;
  const double by_volume =
      (thin.specific_internal_energy.value - dense.specific_internal_energy.value) / (0.3 * V);
  const double by_temperature = 10000 * (hot.pressure.value - cold.pressure.value) / 4000 -
                                0.5 * (hot.pressure.value + cold.pressure.value);
  const double noise = std::hypot(
      std::hypot(thin.specific_internal_energy.error, dense.specific_internal_energy.error) / (0.3 * V),
      2.0 * hot.pressure.error, 3.0 * cold.pressure.error);
  EXPECT_NEAR(by_volume, by_temperature, 3 * noise + 0.05 * by_temperature);
  EXPECT_LT(noise, 0.2 * by_temperature);
}

TEST(Fluid, StateBetweenMeltAndVapourIsNamed) {
  const auto [p, message] = fluid(2.5, 2500, 5000);
  EXPECT_FALSE(p.uniform);
  EXPECT_GT(p.density_wave * 256, 4);
  EXPECT_NE(message.find("between melt and vapour"), std::string::npos) << message;
}

}  // namespace
}  // namespace whipple::md

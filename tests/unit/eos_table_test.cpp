// SPDX-License-Identifier: BSD-3-Clause
// Tables of equations of state: the identities hold by construction, and nothing is evaluated outside of the
// range in silence. The error: tests/verification/eos_table_error_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "eos/identities.hpp"
#include "eos/loci/hugoniot.hpp"
#include "eos/table/builder.hpp"
#include "eos/table/table_of_model.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos {
namespace {

const test::GrayEos& copper() {
  static const test::GrayEos eos(test::copper());
  return eos;
}
const Table& copper_table() {
  static const Table table(tabulate(copper(), {}));
  return table;
}

/// One point through the batch function.
struct Point {
  double pressure, temperature, sound_speed, melted, vaporised;
  RangeReport report;
};
Point evaluate(const EquationOfState& eos, double rho, double e) {
  Point p{};
  p.report = eos.evaluate({{&rho, 1},
                           {&e, 1},
                           {&p.pressure, 1},
                           {&p.temperature, 1},
                           {&p.sound_speed, 1},
                           {&p.melted, 1},
                           {&p.vaporised, 1}});
  return p;
}

TEST(EosTable, a_smaller_request_makes_a_smaller_error) {
  const Table coarse(tabulate(copper(), {.error = 1e-2}));
  const auto loose = verify(coarse, copper(), 50000), tight = verify(copper_table(), copper(), 50000);
  for (const char* phase : {"solid", "liquid"})
    EXPECT_GT(loose.at(phase).pressure, 4 * tight.at(phase).pressure) << phase;
  EXPECT_LT(coarse.data().cells.size(), copper_table().data().cells.size());
  EXPECT_LT(copper_table().data().size(), 1000000U);  // stays in a second-level cache
}

// Runs meet states that no table holds: there the model answers, to the last bit, and what it does not
// describe either is counted.
TEST(EosTable, what_it_does_not_hold_its_model_computes) {
  const auto model = std::make_shared<const test::GrayEos>(test::copper());
  const TableOfModel backed(copper_table(), model);
  const double hot = copper_table().maximum_energy(12000.0) * 1.2;
  const double gas = model->state_at_temperature(1e-3, 6000.0).specific_internal_energy;
  const double density[] = {12000.0, 12000.0, 1e-3, 1e6};
  const double energy[] = {4e6, hot, gas, 1e6};
  double pressure[4], temperature[4], sound_speed[4];
  const RangeReport report = backed.evaluate({density, energy, pressure, temperature, sound_speed, {}, {}});
  EXPECT_EQ(report.out_of_range, 1U);
  EXPECT_EQ(report.first, 3U);
  EXPECT_FALSE(report.bound.empty());
  EXPECT_EQ(
      copper_table().evaluate({density, energy, pressure, temperature, sound_speed, {}, {}}).out_of_range,
      3U);
  static_cast<void>(backed.evaluate({density, energy, pressure, temperature, sound_speed, {}, {}}));
  for (int i = 0; i < 3; ++i) {
    const Point wanted = evaluate(i == 0 ? static_cast<const EquationOfState&>(copper_table()) : *model,
                                  density[i], energy[i]);
    EXPECT_EQ(pressure[i], wanted.pressure) << i;
    EXPECT_EQ(temperature[i], wanted.temperature) << i;
    EXPECT_EQ(sound_speed[i], wanted.sound_speed) << i;
    EXPECT_EQ(backed.state(density[i], energy[i]).temperature,
              (i == 0 ? copper_table().state(density[i], energy[i]) : model->state(density[i], energy[i]))
                  .temperature)
        << i;
  }
  EXPECT_EQ(backed.state_at_temperature(12000.0, 7e4).pressure,
            model->state_at_temperature(12000.0, 7e4).pressure);
  EXPECT_EQ(backed.maximum_density(), model->maximum_density());
  EXPECT_EQ(backed.minimum_energy(1e-3), model->minimum_energy(1e-3));
  EXPECT_THROW(static_cast<void>(backed.state(1e6, 1e6)), StateError);
}

TEST(EosTable, identities_hold_in_every_phase) {
  const Table& table = copper_table();
  struct Probe {
    double rho, T;
    const char* phase;
  };
  for (const Probe& probe : {Probe{9000, 400, "solid"},
                             {12000, 5600, "liquid"},
                             {9500, 2150, "melting"},
                             {8000, 14000, "hot liquid"},
                             {1500, 9000, "hot vapour"},
                             {20, 4000, "vapour"}}) {
    SCOPED_TRACE(probe.phase);
    const State s = table.state_at_temperature(probe.rho, probe.T);
    EXPECT_EQ(s.phase, probe.phase);
    EXPECT_NEAR(s.temperature / probe.T, 1, 1e-9);
    // The differences straddle cells, where the third derivatives of s jump.
    const IdentityDefects d = check_identities(table, probe.rho, s.specific_internal_energy, 1e-4);
    EXPECT_LT(std::abs(d.entropy_energy), 1e-7);
    EXPECT_LT(std::abs(d.entropy_volume), 1e-7);
    EXPECT_LT(std::abs(d.sound_speed), 1e-4);
    EXPECT_LT(std::abs(d.heat_capacity), 1e-4);
    EXPECT_LT(std::abs(d.gruneisen), 1e-4);
    EXPECT_LT(std::abs(d.pressure), 1e-4);
  }
}

TEST(EosTable, batch_and_state_agree) {
  for (const double rho : {0.1, 10.0, 500.0, 3000.0, 7500.0, 8940.0, 15000.0, 25000.0}) {
    for (const double T : {60.0, 300.0, 2000.0, 8000.0, 40000.0}) {
      const State s = copper_table().state_at_temperature(rho, T);
      const Point p = evaluate(copper_table(), rho, s.specific_internal_energy);
      EXPECT_EQ(p.report.out_of_range + p.report.below_cold_curve, 0U);
      EXPECT_NEAR(p.temperature, s.temperature, 1e-9 * s.temperature);
      EXPECT_NEAR(p.pressure, s.pressure, 1e-9 * (std::abs(s.pressure) + rho * 1e5));
      EXPECT_NEAR(p.sound_speed, s.sound_speed, 1e-6 * s.sound_speed);
      EXPECT_NEAR(p.melted, s.melted_fraction, 1e-9);
      EXPECT_NEAR(p.vaporised, s.vaporised_fraction, 1e-9);
    }
  }
}

TEST(EosTable, hugoniot_is_that_of_the_model) {
  const Hugoniot exact(copper()), tabulated(copper_table());
  for (const double up : {500.0, 1500.0, 3000.0, 5000.0}) {
    const double us = exact.at_particle_velocity(up).shock_velocity;
    EXPECT_NEAR(tabulated.at_particle_velocity(up).shock_velocity / us, 1, 1e-3) << up;
  }
}

TEST(EosTable, the_range_is_reported) {
  const Table& table = copper_table();
  const double rho = 8940, coldest = table.minimum_energy(rho);
  const Point cold = evaluate(table, rho, coldest - 1e5), rim = evaluate(table, rho, coldest);
  EXPECT_EQ(cold.report.below_cold_curve, 1U);
  EXPECT_EQ(cold.report.out_of_range, 0U);
  EXPECT_DOUBLE_EQ(cold.pressure, rim.pressure);
  EXPECT_NEAR(cold.temperature, 50, 0.01);

  for (const auto& [density, energy, bound] :
       {std::tuple{2 * table.maximum_density(), 1e5, "density outside the table"},
        {0.5 * table.minimum_density(), 5e6, "density outside the table"},
        {rho, 2 * table.maximum_energy(rho), "energy above the table"},
        {std::nan(""), 1e5, "must be finite"},
        {-1.0, 1e5, "must be finite"},
        {rho, std::nan(""), "must be finite"}}) {
    const Point p = evaluate(table, density, energy);
    EXPECT_EQ(p.report.out_of_range, 1U) << bound;
    EXPECT_THAT(std::string(p.report.bound), ::testing::HasSubstr(bound));
    for (const double value : {p.pressure, p.temperature, p.sound_speed, p.melted, p.vaporised})
      EXPECT_TRUE(std::isnan(value)) << bound;
  }
  EXPECT_THROW((void)table.state(2 * table.maximum_density(), 1e5), StateError);
  EXPECT_THROW((void)table.state(rho, 2 * table.maximum_energy(rho)), StateError);
  EXPECT_THROW((void)table.state_at_temperature(rho, 10), StateError);
  EXPECT_THROW((void)table.state_at_temperature(rho, 1e6), StateError);
}

TEST(EosTable, other_models) {
  const test::MieGruneisenEos aluminium(test::aluminium_2024());
  const Table table(tabulate(aluminium, {.minimum_density = 1500}));
  const auto errors = verify(table, aluminium, 50000);
  EXPECT_LT(errors.at("solid").temperature, 1e-3);
  EXPECT_LT(errors.at("solid").pressure, 1e-3);
}

TEST(EosTable, refuses_what_it_cannot_hold) {
  EXPECT_THROW(tabulate(copper(), {.error = 0}), InputError);
  EXPECT_THROW(tabulate(copper(), {.maximum_density = 1e6}), InputError);
  EXPECT_THROW(tabulate(copper(), {.least_temperature = 0.1}), InputError);
  EXPECT_THROW(tabulate(copper(), {.least_temperature = 500, .greatest_temperature = 400}), InputError);
}

}  // namespace
}  // namespace whipple::eos

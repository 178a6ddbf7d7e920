// SPDX-License-Identifier: BSD-3-Clause
// Curves of equations of state as data, called without the command line: against the straight Us-up line that the
// model is built on, the symmetry of an impact, and the identity of samples.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "eos/curves/diagrams.hpp"
#include "eos/curves/planar_impact.hpp"
#include "eos/curves/samples.hpp"
#include "eos/curves/tables.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::curves {
namespace {

constexpr double c0 = 5328.0, slope = 1.338, rho0 = 2785.0;  // of test::aluminium_2024

Subject aluminium(const std::string& name = "aluminium", double intercept = c0) {
  MieGruneisenConstants constants = test::aluminium_2024();
  constants.hugoniot_intercept = intercept;
  return {name, std::make_shared<test::MieGruneisenEos>(constants)};
}

double number(const CurveTable& table, const CurveRow& row, const char* column) {
  return std::get<double>(row[column_index(table, column)]);
}

TEST(EosCurves, HugoniotIsTheLineOfTheModel) {
  const CurveTable table =
      hugoniot_table({aluminium()}, {}, {}, Variable::particle_velocity, {500.0, 2500.0, 5});
  ASSERT_EQ(table.series.size(), 1U);
  ASSERT_EQ(table.series[0].rows.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const CurveRow& row = table.series[0].rows[i];
    const double up = number(table, row, "up_km_s"), us = number(table, row, "us_km_s");
    EXPECT_NEAR(up, 500.0 + 500.0 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(us, c0 + slope * up, 1e-6);
    EXPECT_NEAR(number(table, row, "P_GPa"), rho0 * us * up, 1e3);
  }
  EXPECT_EQ(table.title, "Principal Hugoniot: aluminium (mie_gruneisen)");
  EXPECT_THROW(column_index(table, "P"), InputError);
}

// The sizes come from the unit library; that of the pressure was exact before it did.
TEST(EosCurves, UnitsOfTheColumnsAreExact) {
  for (const Column& column : state_columns()) {
    const double exact = column.unit == "GPa"                                      ? 1e9
                         : column.unit.starts_with("k") && column.unit != "kg/m^3" ? 1e3
                         : column.unit == "1e-6/K"                                 ? 1e-6
                                                                                   : 1.0;
    EXPECT_EQ(column.size, exact) << column.name;
  }
  EXPECT_THROW(quantity_column("P", "GPa", "m/s", "pressure"), InputError);
}

TEST(EosCurves, ACurveEndsWithTheModelAndSaysWhy) {
  const CurveTable table = hugoniot_table({aluminium()}, {}, {}, Variable::particle_velocity, {0.0, 1e5, 50});
  EXPECT_LT(table.series[0].rows.size(), 50U);
  EXPECT_GT(table.series[0].rows.size(), 1U);
  EXPECT_FALSE(table.series[0].end.empty());
  EXPECT_TRUE(hugoniot_table({aluminium()}, {}, {}, Variable::pressure, {}).series[0].end.empty());
}

TEST(EosCurves, StatesAreNamedByTwoQuantities) {
  const Subject subject = aluminium();
  const State named = state_of(*subject.eos, {.density = 3000.0, .temperature = 500.0});
  const State again = state_of(*subject.eos, {.density = 3000.0, .pressure = named.pressure});
  EXPECT_NEAR(again.specific_internal_energy, named.specific_internal_energy,
              1e-6 * named.specific_internal_energy);
  EXPECT_EQ(state_of(*subject.eos, {}).density, rho0);
  EXPECT_THROW(state_of(*subject.eos, {.density = 3000.0}), InputError);
  EXPECT_THROW(required_shock(*subject.eos, {}, {}), InputError);
  EXPECT_THROW(hugoniot_of(*subject.eos, {.initial_density = 3000.0}), InputError);
  EXPECT_THROW(interfaces({subject}, 1000.0), InputError);
  EXPECT_THROW(interfaces({subject, subject}, 0.0), InputError);
}

TEST(EosCurves, EqualMaterialsShareTheVelocityOfAnImpact) {
  const Subject subject = aluminium();
  const PlanarImpact impact = planar_impact(*subject.eos, *subject.eos, 2000.0);
  EXPECT_NEAR(impact.interface_velocity, 1000.0, 1e-6);
  EXPECT_NEAR(impact.pressure, rho0 * (c0 + slope * 1000.0) * 1000.0, 1e3);
  ASSERT_TRUE(impact.free_surface_velocity && impact.target.released);
  EXPECT_NEAR(*impact.free_surface_velocity, 2000.0, 0.03 * 2000.0);  // the rule of the doubled velocity
  EXPECT_NEAR(impact.target.released->pressure, 0.0, 1e3);
  const CurveTable table = match_table({subject, subject}, 2000.0);
  EXPECT_NEAR(number(table, table.series[0].rows[1], "P_GPa"), impact.pressure, 1e3);
}

TEST(EosCurves, SamplesScatterAsTheirConstants) {
  const std::vector<double> velocities = {500.0, 1000.0};
  const Subjects samples = {aluminium("a", c0 - 30.0), aluminium("a"), aluminium("a", c0 + 30.0)};
  const SampledHugoniot sampled = sampled_hugoniot(samples, velocities, 1e5);
  for (const CurveRow& row : sampled.table.series[0].rows) {
    const double up = number(sampled.table, row, "up_km_s");
    EXPECT_NEAR(number(sampled.table, row, "us_km_s"), c0 + slope * up, 1e-6);
    EXPECT_NEAR(number(sampled.table, row, "sd-us_km_s"), 30.0, 1e-6);
    EXPECT_EQ(number(sampled.table, row, "samples"), 3.0);
  }
  EXPECT_THROW(sampled_hugoniot({aluminium()}, velocities, 1e5), InputError);
}

TEST(EosCurves, DiagramsHoldTheirLoci) {
  const Figure figure = diagram(DiagramKind::pressure_volume, {aluminium()}, 50e9);
  ASSERT_FALSE(figure.curves.empty());
  EXPECT_EQ(figure.curves[0].label, "Hugoniot");
  EXPECT_EQ(figure.x.name, "V_over_V0");
  EXPECT_NEAR(figure.curves[0].y.back(), 50.0, 1e-9);  // in the unit of the axis
  EXPECT_LT(figure.curves[0].x.back(), 0.8);
  const Figure shocks = diagram(DiagramKind::shock_velocity, {aluminium()}, 50e9);
  EXPECT_NEAR(shocks.curves[0].y.back(), 1e-3 * c0 + slope * shocks.curves[0].x.back(), 1e-9);
  EXPECT_THROW(diagram(DiagramKind::shock_velocity, {aluminium()}, 0.0), InputError);
}

}  // namespace
}  // namespace whipple::eos::curves

// SPDX-License-Identifier: BSD-3-Clause
// The Mie-Grueneisen model reproduces the linear Hugoniot that it is built on, and figures computed from its
// definition.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "eos/loci.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

TEST(EosMieGruneisen, ReproducesItsLinearHugoniotForBothLaws) {
  for (const auto law : {CompressedGruneisenLaw::constant_product, CompressedGruneisenLaw::constant}) {
    const MieGruneisenEos eos(aluminium_2024(law));
    const Hugoniot hugoniot(eos);
    for (double up : {1.0, 10.0, 100.0, 500.0, 1000.0, 2000.0, 3000.0}) {
      const ShockState s = hugoniot.at_particle_velocity(up);
      const double us = 5328 + 1.338 * up;
      EXPECT_NEAR(s.shock_velocity, us, 1e-10 * us) << word_of(law) << " up " << up;
      EXPECT_NEAR(s.particle_velocity, up, 1e-10 * up);
      EXPECT_NEAR(s.state.pressure, 2785 * us * up, 1e-10 * 2785 * us * up);
      EXPECT_NEAR(s.state.specific_internal_energy, 0.5 * up * up, 1e-10 * up * up);
    }
  }
}

TEST(EosMieGruneisen, ShockedStatesOfAluminiumHaveTheKnownFigures) {
  // Symmetric impact: particle velocity, shock velocity (m/s), pressure (GPa), density (kg/m^3) of the linear
  // Hugoniot.
  const MieGruneisenEos eos(aluminium_2024());
  const double table[4][4] = {{500, 5997, 8.351, 3038.3},
                              {1000, 6666, 18.565, 3276.5},
                              {2000, 8004, 44.582, 3712.7},
                              {3000, 9342, 78.052, 4102.4}};
  for (const auto& row : table) {
    const ShockState s = Hugoniot(eos).at_particle_velocity(row[0]);
    EXPECT_NEAR(s.shock_velocity, row[1], 0.5);
    EXPECT_NEAR(s.state.pressure * 1e-9, row[2], 0.0005);
    EXPECT_NEAR(s.state.density, row[3], 0.05);
  }
}

TEST(EosMieGruneisen, ReleaseToZeroPressureLeavesTheKnownHeat) {
  // Energy and density after shock and full release by an independent integration of (M1) to (M3):
  // classical Runge-Kutta of fourth order, steps of 1e-5 V0.
  const MieGruneisenEos eos(aluminium_2024());
  const double table[4][3] = {
      {500, 8423.7, 2783.34}, {1000, 55795.2, 2774.08}, {2000, 322746.0, 2723.06}, {3000, 823259.8, 2632.30}};
  for (const auto& row : table) {
    const ShockState shock = Hugoniot(eos).at_particle_velocity(row[0]);
    const Release r = release(eos, shock.state, 0.0);
    EXPECT_NEAR(r.end.state.specific_internal_energy, row[1], 1.0) << row[0];
    EXPECT_NEAR(r.end.state.density, row[2], 0.03) << row[0];
    // The free surface moves at nearly twice the particle velocity.
    EXPECT_NEAR((row[0] - r.end.riemann_velocity) / (2 * row[0]), 1.0, 0.03) << row[0];
    EXPECT_GT(row[0] - r.end.riemann_velocity, 2 * row[0]);
    EXPECT_NEAR(r.end.state.pressure, 0.0, 1e3);
    EXPECT_NEAR(r.end.state.specific_entropy, shock.state.specific_entropy, 1e-6) << row[0];
  }
}

TEST(EosMieGruneisen, ThermalPressureActsInExpansionToo) {
  const MieGruneisen eos(aluminium_2024());
  const double rho = 0.97 * 2785;
  const State cold = eos.state(rho, 0.0), hot = eos.state(rho, 1e5);
  EXPECT_NEAR(hot.pressure - cold.pressure, 2.0 * rho * 1e5, 1e-6 * 2.0 * rho * 1e5);
  EXPECT_NEAR(cold.pressure, 5328.0 * 5328.0 * (rho - 2785), 1.0);
}

TEST(EosMieGruneisen, ReferenceStateIsAtRest) {
  const MieGruneisen eos(aluminium_2024());
  const State s = eos.state_at_temperature(2785, 300);
  EXPECT_NEAR(s.pressure, 0.0, 1e-3);
  EXPECT_NEAR(s.specific_internal_energy, 0.0, 1e-9);
  EXPECT_NEAR(s.sound_speed, 5328, 1e-6);
}

TEST(EosMieGruneisen, RangeAndPoliciesAreReported) {
  const MieGruneisenEos eos(aluminium_2024());
  EXPECT_LT(eos.maximum_density(), 2785 / (1 - 0.95 / 1.338) * 1.0001);
  EXPECT_GT(eos.maximum_density(), 1.5 * 2785);
  std::vector<double> rho = {2785, 3000, 2 * eos.maximum_density()}, e = {-1e7, 1e5, 1e5}, P(3), T(3), c(3);
  const RangeReport report = eos.evaluate({rho, e, P, T, c, {}, {}});
  EXPECT_EQ(report.below_cold_curve, 1u);
  EXPECT_EQ(report.out_of_range, 1u);
  EXPECT_EQ(report.first, 2u);
  EXPECT_THROW(static_cast<void>(eos.state(2 * eos.maximum_density(), 0)), StateError);
}

// A slope of 1e300 ends the curve before its first interval.
TEST(EosMieGruneisen, CurvesWithoutCompressionAreRefused) {
  for (const double slope : {200.0, 1e20, 1e300, 1e308}) {
    MieGruneisenConstants constants = aluminium_2024();
    constants.hugoniot_slope = slope;
    try {
      const MieGruneisenEos eos(constants);
      FAIL() << "no error with the slope " << slope;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("at no compression to speak of"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace whipple::eos::test

// SPDX-License-Identifier: BSD-3-Clause
// Strength models: published flow stresses, and the yield condition after the radial return.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "src/material/strength/catalogue.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace {

using material_test::ofhc_copper;
using material_test::taylor_copper;

TEST(JohnsonCook, GivesTheFlowStressOfThePublishedFormulaForCopper) {
  // (90 + 292 ep^0.31) MPa (1 + 0.025 ln rate) (1 - ((T - 294)/1062)^1.09), evaluated with a pocket
  // calculator.
  const strength::JohnsonCook copper = ofhc_copper();
  EXPECT_NEAR(copper.flow_stress(0.0, 1.0, 294.0), 90.0e6, 1.0);
  EXPECT_NEAR(copper.flow_stress(1.0, 1.0, 294.0), 382.0e6, 1.0);
  // ep^n = exp(0.31 ln 0.3) = 0.688506; rate 1e4: 1 + 0.025 * 9.210340 = 1.2302585; T = 600 K: T* =
  // 0.2881356, T*^1.09 = exp(1.09 * -1.244324) = 0.257609 -> (90 + 201.0437) * 1.2302585 * 0.742391 = 265.82
  // MPa
  EXPECT_NEAR(copper.flow_stress(0.3, 1e4, 600.0), 265.82e6, 0.01e6);
}

TEST(JohnsonCook, RateFactorIsOneBelowTheReferenceRate) {
  const strength::JohnsonCook copper = ofhc_copper();
  EXPECT_EQ(copper.flow_stress(0.1, 1e-6, 294.0), copper.flow_stress(0.1, 1.0, 294.0));
  EXPECT_EQ(copper.flow_stress(0.1, 0.0, 294.0), copper.flow_stress(0.1, 1.0, 294.0));
}

TEST(JohnsonCook, LosesItsStrengthAtTheMeltingTemperatureAndKeepsItWithoutTemperature) {
  const strength::JohnsonCook copper = ofhc_copper();
  EXPECT_EQ(copper.flow_stress(0.5, 1e3, 1356.0), 0.0);
  EXPECT_EQ(copper.flow_stress(0.5, 1e3, 5000.0), 0.0);
  EXPECT_EQ(copper.flow_stress(0.5, 1e3, 77.0), copper.flow_stress(0.5, 1e3, 294.0));
  EXPECT_EQ(copper.flow_stress(0.5, 1e3, eos::State::unknown), copper.flow_stress(0.5, 1e3, 294.0));
}

TEST(JohnsonCook, YieldConditionHoldsAfterTheReturnForRandomStates) {
  // q - 3 G x = w Y(ep + x, x/dt, T) with the hardening, rate and temperature of the end of the step; ep = 0
  // (infinite slope of the power law) and steps from 1 ns to 1 us are among the states.
  const strength::JohnsonCook copper = ofhc_copper();
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int yielding = 0;
  for (int i = 0; i < 20000; ++i) {
    const double strain = i % 5 == 0 ? 0.0 : std::pow(10.0, -6.0 + 7.0 * unit(generator));
    const double temperature = 200.0 + 1300.0 * unit(generator);
    const double solid = i % 3 == 0 ? unit(generator) + 1e-3 : 1.0;
    const double modulus = 47.7e9 * solid;
    const double dt = std::pow(10.0, -9.0 + 3.0 * unit(generator));
    const double trial = std::pow(10.0, 6.0 + 4.0 * unit(generator));
    const double x = copper.increment(trial, strain, temperature, modulus, solid, dt);
    ASSERT_GE(x, 0.0);
    const double flow = solid * copper.flow_stress(strain + x, x / dt, temperature);
    if (x > 0.0) {
      ++yielding;
      ASSERT_NEAR(trial - 3.0 * modulus * x, flow, 1e-9 * trial) << "state " << i;
    } else {
      ASSERT_LE(trial, flow * (1.0 + 1e-15));
    }
  }
  EXPECT_GT(yielding, 10000);
}

TEST(VonMises, YieldConditionHoldsAfterTheReturnBelowOnAndAboveThePlateau) {
  strength::VonMises constants = taylor_copper();
  constants.maximum_flow_stress = 300e6;
  const double plateau_strain = (300e6 - 157e6) / 425e6;
  for (const double strain : {0.0, 0.1, 0.99 * plateau_strain, plateau_strain, 2.0 * plateau_strain}) {
    for (const double trial : {100e6, 200e6, 400e6, 4e9}) {
      for (const double solid : {1.0, 0.3}) {
        const double modulus = solid * constants.shear_modulus;
        const double x = constants.increment(trial, strain, modulus, solid);
        const double flow = solid * constants.flow_stress(strain + x);
        if (x > 0.0) {
          EXPECT_NEAR(trial - 3.0 * modulus * x, flow, 1e-12 * trial);
        } else {
          EXPECT_LE(trial, flow);
        }
      }
    }
  }
}

TEST(StrengthModels, ShearModulusFromYoungsModulusAndPoissonRatio) {
  strength::VonMises constants = taylor_copper();
  constants.shear_modulus = 0.0;
  constants.youngs_modulus = 117e9;
  constants.poisson_ratio = 0.35;
  EXPECT_NEAR(constants.stiffness(), 43.3333e9, 1e5);
  constants.shear_modulus = 43e9;
  EXPECT_THROW(static_cast<void>(strength::VonMisesModel(constants)), InputError);
  constants.shear_modulus = constants.youngs_modulus = 0.0;
  EXPECT_THROW(static_cast<void>(strength::VonMisesModel(constants)), InputError);
}

TEST(StrengthModels, ContradictingConstantsAreRefused) {
  strength::JohnsonCook copper = ofhc_copper();
  copper.melting_temperature = 200.0;
  EXPECT_THROW(static_cast<void>(strength::JohnsonCookModel(copper)), InputError);
  strength::VonMises constants = taylor_copper();
  constants.maximum_flow_stress = 100e6;
  EXPECT_THROW(static_cast<void>(strength::VonMisesModel(constants)), InputError);
}

TEST(StrengthModels, CatalogueDescribesEveryModelWithItsConstants) {
  for (const strength::ModelEntry& entry : strength::catalogue()) {
    EXPECT_THAT(entry.describe(), ::testing::HasSubstr(entry.name));
    EXPECT_FALSE(entry.summary.empty());
  }
  EXPECT_THAT(strength::catalogue()[2].describe(), ::testing::HasSubstr("hardening_exponent"));
}

}  // namespace
}  // namespace whipple

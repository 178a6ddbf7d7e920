// SPDX-License-Identifier: BSD-3-Clause
// Strength models: published flow stresses, and the yield condition after the radial return.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "src/material/strength/catalogue.hpp"
#include "src/material/strength/power_law.hpp"
#include "src/material/strength/preston_tonks_wallace.hpp"
#include "src/material/strength/steinberg_guinan.hpp"
#include "src/material/strength/voce.hpp"
#include "src/material/strength/zerilli_armstrong.hpp"
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
        const double x = constants.increment(trial, strain, 300.0, modulus, solid, 1e-8);
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

strength::SteinbergGuinan steinberg_copper() {  // UCRL-MA-106439 (1996), OFHC copper, half hard
  strength::SteinbergGuinan c;
  c.reference_density = 8930.0;
  c.shear_modulus = 47.7e9;
  c.pressure_coefficient = 2.83e-11;
  c.temperature_coefficient = 3.77e-4;
  c.yield_stress = 0.12e9;
  c.maximum_flow_stress = 0.64e9;
  c.hardening_coefficient = 36.0;
  c.hardening_exponent = 0.45;
  return c;
}

TEST(SteinbergGuinan, HasThePublishedSlopesOfTheShearModulus) {
  // dG/dp = 1.35 and dG/dT = -17.98 MPa/K: Steinberg, Cochran and Guinan, J. Appl. Phys. 51 (1980) 1498.
  const strength::SteinbergGuinan c = steinberg_copper();
  const double g0 = c.shear_modulus;
  EXPECT_NEAR(g0 * (c.stiffness_ratio(8930.0, 1e6, 300.0) - 1.0) / 1e6, 1.35, 0.005);
  EXPECT_NEAR(g0 * (c.stiffness_ratio(8930.0, 0.0, 301.0) - 1.0), -17.98e6, 0.01e6);
  EXPECT_EQ(c.stiffness_ratio(8930.0, 0.0, eos::State::unknown), 1.0);
  EXPECT_GT(c.stiffness_ratio(8930.0, 0.0, 20000.0), 0.0);  // soft, never without stiffness
}

TEST(SteinbergGuinan, HardensToItsBound) {
  const strength::SteinbergGuinan c = steinberg_copper();
  EXPECT_NEAR(c.hardening(0.0).value, 120e6, 1.0);
  EXPECT_NEAR(c.hardening(0.1).value, 120e6 * std::pow(4.6, 0.45), 1.0);
  EXPECT_EQ(c.hardening(5.0).value, 640e6);
}

TEST(SteinbergGuinan, YieldConditionHoldsAfterTheReturnBelowAndAboveTheBoundAndForAllExponents) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int yielding = 0;
  for (int i = 0; i < 20000; ++i) {
    strength::SteinbergGuinan c = steinberg_copper();
    c.hardening_exponent = i % 4 == 0 ? 2.0 * unit(generator) : 0.45;  // above 1 it stiffens
    const double strain = i % 5 == 0 ? 0.0 : std::pow(10.0, -6.0 + 7.0 * unit(generator));
    const double solid = i % 3 == 0 ? unit(generator) + 1e-3 : 1.0;
    const double ratio = 0.1 + 2.0 * unit(generator), modulus = ratio * solid * c.shear_modulus;
    const double trial = std::pow(10.0, 6.0 + 4.0 * unit(generator));
    const double x = c.increment(trial, strain, modulus, solid);
    ASSERT_GE(x, 0.0);
    const double flow = solid * ratio * c.hardening(strain + x).value;
    if (x > 0.0) {
      ++yielding;
      ASSERT_NEAR(trial - 3.0 * modulus * x, flow, 2e-12 * trial) << "state " << i;
    } else {
      ASSERT_LE(trial, flow * (1.0 + 1e-14)) << "state " << i;
    }
  }
  EXPECT_GT(yielding, 8000);
}

TEST(ZerilliArmstrong, GivesThePublishedFormulaForBothStructures) {
  strength::ZerilliArmstrong copper;
  copper.shear_modulus = 47.7e9;
  copper.athermal_stress = 65e6;
  copper.thermal_hardening = 890e6;
  copper.thermal_coefficient = 0.0028;
  copper.rate_coefficient = 0.000115;
  // 65 + 890 sqrt(0.3) exp(-0.84 + 0.000115 * 300 * 9.210340) = 65 + 487.473 * exp(-0.522243) MPa
  EXPECT_NEAR(copper.flow_stress(0.3, 1e4, 300.0), 354.16e6, 0.05e6);
  strength::ZerilliArmstrong iron;
  iron.shear_modulus = 80e9;
  iron.thermal_stress = 1033e6;
  iron.thermal_coefficient = 0.00698;
  iron.rate_coefficient = 0.000415;
  iron.hardening_coefficient = 266e6;
  iron.hardening_exponent = 0.289;
  // 1033 exp(-2.094) + 266 * 0.1^0.289 = 127.26 + 136.73 MPa
  EXPECT_NEAR(iron.flow_stress(0.1, 1.0, 300.0), 263.99e6, 0.1e6);
}

/// Constants of Preston, Tonks and Wallace, J. Appl. Phys. 93 (2003) 211.
strength::PrestonTonksWallace ptw_copper() {
  strength::PrestonTonksWallace c;
  c.reference_density = 8930.0;
  c.shear_modulus = 51.8e9;
  c.thermal_softening = 0.20;
  c.melting_temperature = 1358.0;
  c.molar_mass = 63.546e-3;
  c.hardening = 0.025;
  c.hardening_shape = 2.0;
  c.cold_saturation = 0.0085;
  c.hot_saturation = 0.00055;
  c.cold_yield = c.hot_yield = 0.0001;
  c.activation = 0.11;
  c.attempt_rate = 1e-5;
  c.medium_rate_stress = 0.094;
  c.medium_rate_exponent = 0.575;
  c.drag_exponent = 0.25;
  return c;
}

strength::PrestonTonksWallace ptw_tantalum() {
  strength::PrestonTonksWallace c;
  c.reference_density = 16690.0;
  c.shear_modulus = 72.2e9;
  c.thermal_softening = 0.23;
  c.melting_temperature = 3269.0;
  c.molar_mass = 180.948e-3;
  c.hardening = 0.02;
  c.cold_saturation = 0.012;
  c.hot_saturation = 0.00325;
  c.cold_yield = 0.01;
  c.hot_yield = 0.00125;
  c.activation = 0.6;
  c.attempt_rate = 4e-5;
  c.medium_rate_stress = 0.012;
  c.medium_rate_exponent = 0.4;
  c.drag_exponent = 0.23;
  return c;
}

double flow_of(const strength::Strength& model, double strain, double rate, double temperature,
               double density, double pressure = 0.0) {
  const std::array at = {strain}, per_second = {rate}, hot = {temperature}, dense = {density},
                   pressed = {pressure};
  std::array<double, 1> flow{};
  model.flow_stress({dense, pressed, hot, at}, per_second, flow);
  return flow[0];
}

// The published formula with the published constants, evaluated apart in double precision.
TEST(PrestonTonksWallace, GivesThePublishedFormulaWithAndWithoutTheShapeOfHardening) {
  const strength::PrestonTonksWallaceModel copper(ptw_copper()), tantalum(ptw_tantalum());
  const auto cu = [&](double strain, double rate, double T) {
    return 1e-6 * flow_of(copper, strain, rate, T, 8930.0);
  };
  EXPECT_NEAR(cu(0.05, 1e-3, 300.0), 108.13, 0.01);
  EXPECT_NEAR(cu(0.3, 1e3, 300.0), 370.65, 0.01);
  EXPECT_NEAR(cu(0.3, 1e4, 800.0), 298.35, 0.01);
  EXPECT_NEAR(cu(0.3, 1e6, 300.0), 584.88, 0.01);
  EXPECT_NEAR(cu(1.0, 1e4, 300.0), 593.44, 0.01);
  const auto ta = [&](double strain, double rate, double T) {
    return 1e-6 * flow_of(tantalum, strain, rate, T, 16690.0);
  };
  EXPECT_NEAR(ta(0.05, 1e-3, 300.0), 338.50, 0.01);
  EXPECT_NEAR(ta(0.3, 1e5, 300.0), 1115.32, 0.01);
  EXPECT_NEAR(ta(1.0, 1e3, 1000.0), 437.76, 0.01);
}

TEST(PrestonTonksWallace, StrongShocksFollowThePowerLawOfDragAndTemperIsAStrain) {
  const strength::PrestonTonksWallaceModel copper(ptw_copper());
  // Beyond the attempts of the atoms strain no longer hardens, and stress goes with the rate to the power beta.
  const double slow = flow_of(copper, 0.1, 1e11, 300.0, 8930.0),
               fast = flow_of(copper, 0.1, 1e12, 300.0, 8930.0);
  EXPECT_NEAR(std::log10(fast / slow), 0.25, 1e-12);
  EXPECT_NEAR(flow_of(copper, 1.0, 1e12, 300.0, 8930.0), fast, 1e-9 * fast);
  strength::PrestonTonksWallace worked = ptw_copper();
  worked.initial_plastic_strain = 0.2;
  EXPECT_DOUBLE_EQ(flow_of(strength::PrestonTonksWallaceModel(worked), 0.1, 1e3, 300.0, 8930.0),
                   flow_of(copper, 0.1 + 0.2, 1e3, 300.0, 8930.0));
  strength::PrestonTonksWallace wrong = ptw_copper();
  wrong.hot_saturation = 0.01;
  EXPECT_THROW(strength::PrestonTonksWallaceModel{wrong}, InputError);
}

/// Trial stresses from far below to far above yield, fresh and hardened material, cold and hot, solid and
/// nearly molten, steps from 1 ns to 1 us. `flow(strain, rate, density, pressure, temperature)` is the
/// model's formula.
template <class Flow>
void expect_yield_condition(const strength::Strength& model, const Flow& flow) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int yielding = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::array strain = {i % 5 == 0 ? 0.0 : std::pow(10.0, -6.0 + 7.0 * unit(generator))};
    const std::array temperature = {200.0 + 1000.0 * unit(generator)};
    const std::array density = {8000.0 + 4000.0 * unit(generator)};
    const std::array pressure = {-2e9 + 1e11 * unit(generator)};
    const std::array solid = {i % 3 == 0 ? unit(generator) + 1e-3 : 1.0};
    const strength::State state{density, pressure, temperature, strain};
    std::array<double, 1> modulus{}, increment{};
    model.shear_modulus(state, modulus);
    modulus[0] *= solid[0];
    const double dt = std::pow(10.0, -9.0 + 3.0 * unit(generator));
    const std::array trial = {std::pow(10.0, 6.0 + 4.0 * unit(generator))};
    model.plastic_increment(state, trial, modulus, solid, dt, increment);
    const double x = increment[0];
    ASSERT_GE(x, 0.0);
    const double y = solid[0] * flow(strain[0] + x, x / dt, density[0], pressure[0], temperature[0]);
    if (x > 0.0) {
      ++yielding;
      ASSERT_NEAR(trial[0] - 3.0 * modulus[0] * x, y, 1e-9 * trial[0]) << model.model() << " state " << i;
    } else {
      ASSERT_LE(trial[0], y * (1.0 + 1e-12)) << model.model() << " state " << i;
    }
  }
  EXPECT_GT(yielding, 1000) << model.model();
}

TEST(StrengthModels, YieldConditionHoldsAfterTheReturnOfEveryHardeningLaw) {
  const strength::SteinbergGuinan steinberg = steinberg_copper();
  expect_yield_condition(strength::SteinbergGuinanModel(steinberg), [&](double strain, double, double density,
                                                                        double pressure, double temperature) {
    return steinberg.hardening(strain).value * steinberg.stiffness_ratio(density, pressure, temperature);
  });
  strength::PowerLaw power;
  power.shear_modulus = 27e9;
  power.yield_stress = 50e6;
  power.hardening_coefficient = 300e6;
  power.hardening_exponent = 0.2;
  expect_yield_condition(strength::PowerLawModel(power), [&](double strain, double, double, double, double) {
    return 50e6 + 300e6 * std::pow(strain, 0.2);
  });
  strength::Voce voce;
  voce.shear_modulus = 27e9;
  voce.yield_stress = 50e6;
  voce.first_saturation = 100e6;
  voce.first_rate = 20.0;
  voce.second_saturation = 40e6;
  voce.second_rate = 1.5;
  expect_yield_condition(strength::VoceModel(voce), [&](double strain, double, double, double, double) {
    return 50e6 + 100e6 * (1 - std::exp(-20.0 * strain)) + 40e6 * (1 - std::exp(-1.5 * strain));
  });
  strength::ZerilliArmstrong za;
  za.shear_modulus = 47.7e9;
  za.athermal_stress = 65e6;
  za.thermal_stress = 30e6;
  za.thermal_hardening = 890e6;
  za.thermal_coefficient = 0.0028;
  za.rate_coefficient = 0.000115;
  za.hardening_coefficient = 20e6;
  expect_yield_condition(strength::ZerilliArmstrongModel(za), [&](double strain, double rate, double, double,
                                                                  double temperature) {
    const double thermal =
        std::exp((-0.0028 + 0.000115 * std::log(std::max(rate, za.least_rate))) * temperature);
    return 65e6 + (30e6 + 890e6 * std::sqrt(strain)) * thermal + 20e6 * std::sqrt(strain);
  });
}

TEST(PrestonTonksWallace, SlopeIsTheDerivativeOfTheFlowStress) {
  for (const strength::PrestonTonksWallace& constants : {ptw_copper(), ptw_tantalum()}) {
    for (const double rate : {1.0, 1e4, 1e7, 1e10}) {
      for (const double strain : {0.0, 0.1, 1.0}) {
        constexpr double x = 1e-3, step = 1e-7;
        const double frequency = constants.frequency(constants.reference_density, 45e9), dt = x / rate;
        const auto at = [&](double of) { return constants.flow(strain, of, dt, 0.3, 45e9, frequency); };
        const double slope = (at(x + step).value - at(x - step).value) / (2.0 * step);
        EXPECT_NEAR(at(x).slope, slope, 1e-5 * std::abs(slope)) << rate << ' ' << strain;
      }
    }
  }
}

TEST(PrestonTonksWallace, SatisfiesTheYieldConditionOfTheEndOfTheStep) {
  for (strength::PrestonTonksWallace constants : {ptw_copper(), ptw_tantalum()}) {
    constants.pressure_coefficient = 0.0283e-9;
    const strength::PrestonTonksWallaceModel model(constants);
    expect_yield_condition(
        model, [&](double strain, double rate, double density, double pressure, double temperature) {
          return flow_of(model, strain, rate, temperature, density, pressure);
        });
  }
}

/// Points of a batch, some of which yield, have the increments that each has alone, bit by bit.
void expect_independent_points(const strength::Strength& model) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr std::size_t n = 203;
  std::vector<double> density(n, 8930.0), pressure(n, 1e9), temperature(n), strain(n), solid(n), trial(n),
      modulus(n), together(n);
  for (std::size_t i = 0; i < n; ++i) {
    temperature[i] = 200.0 + 900.0 * unit(generator);
    strain[i] = i % 5 == 0 ? 0.0 : unit(generator);
    solid[i] = i % 3 == 0 ? unit(generator) + 1e-3 : 1.0;
    trial[i] =
        i >= 64 && i < 128 ? 5e9 : std::pow(10.0, 7.0 + 3.0 * unit(generator));  // in one batch all yield
  }
  constexpr double dt = 1e-8;
  model.shear_modulus({density, pressure, temperature, strain}, modulus);
  for (std::size_t i = 0; i < n; ++i) modulus[i] *= solid[i];
  model.plastic_increment({density, pressure, temperature, strain}, trial, modulus, solid, dt, together);
  std::size_t yielding = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto one = [&](std::vector<double>& of) { return std::span<double>(&of[i], 1); };
    double alone = -1.0;
    model.plastic_increment({one(density), one(pressure), one(temperature), one(strain)}, one(trial),
                            one(modulus), one(solid), dt, {&alone, 1});
    EXPECT_EQ(alone, together[i]) << model.model() << " point " << i;
    yielding += alone > 0.0 ? 1 : 0;
  }
  EXPECT_GT(yielding, 100u);
  EXPECT_LT(yielding, n - 20);
}

TEST(StrengthModels, PointsOfABatchAreIndependent) {
  expect_independent_points(strength::JohnsonCookModel(ofhc_copper()));
  expect_independent_points(strength::SteinbergGuinanModel(steinberg_copper()));
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
    EXPECT_THAT(strength::catalogue().describe(entry.name), ::testing::HasSubstr(entry.describe()));
    EXPECT_FALSE(entry.summary.empty());
  }
  EXPECT_EQ(strength::catalogue().size(), 20U);
}

}  // namespace
}  // namespace whipple

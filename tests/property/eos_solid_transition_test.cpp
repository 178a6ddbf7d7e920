// SPDX-License-Identifier: BSD-3-Clause
// Two solid phases in equilibrium (docs/theory/equations_of_state.md, "Two solid phases").
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "eos/identities.hpp"
#include "eos/loci.hpp"
#include "eos/models/solid_transition.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

using TransitionEos = ModelEquationOfState<SolidTransition>;

/// Alpha and epsilon phase of iron, as in the library.
SolidTransitionConstants iron() {
  SolidTransitionConstants c;
  c.molar_mass = 55.845e-3;
  c.transition_pressure = 13e9;
  c.low.reference_density = 7873.3;
  c.low.isotherm = c.high.isotherm = IsothermForm::birch_murnaghan;
  c.low.bulk_modulus = 163.42e9;
  c.low.bulk_modulus_slope = 6.0173;
  c.low.debye_temperature = 398.0;
  c.low.gruneisen = 1.6673;
  c.low.gruneisen_exponent = 0.9066;
  c.low.electronic_heat_coefficient = 3.88e-3;
  c.low.electronic_gruneisen = 1.4796;
  c.high.reference_density = 8254.9;
  c.high.bulk_modulus = 165e9;
  c.high.bulk_modulus_slope = 4.97;
  c.high.debye_temperature = 379.74;
  c.high.gruneisen = 2.1309;
  c.high.gruneisen_exponent = 1.0225;
  c.high.electronic_heat_coefficient = 4.11e-3;
  c.high.electronic_gruneisen = 1.6927;
  return c;
}

TEST(SolidTransition, PhasesInEquilibriumHaveEqualPressureAndGibbsEnergy) {
  const TransitionEos eos(iron());
  const SolidTransition& model = eos.underlying();
  EXPECT_NEAR(model.transition_pressure(300.0), 13e9, 1e3);
  EXPECT_LT(model.coldest(), 2.0);
  EXPECT_GT(model.hottest(), 1500.0);
  EXPECT_NEAR(1 - model.high_volume(300.0) / model.low_volume(300.0), 0.05, 0.01);
  for (const double T : {80.0, 300.0, 700.0, 1300.0}) {
    const double Vl = model.low_volume(T), Vh = model.high_volume(T);
    const State low = eos.state_at_temperature(1.0 / (Vl * (1 + 1e-9)), T),
                high = eos.state_at_temperature(1.0 / (Vh * (1 - 1e-9)), T);
    EXPECT_EQ(low.phase, "low-pressure solid");
    EXPECT_EQ(high.phase, "high-pressure solid");
    EXPECT_NEAR(low.pressure, model.transition_pressure(T), 2e3) << T;
    EXPECT_NEAR(high.pressure, model.transition_pressure(T), 2e3) << T;
    const auto gibbs = [](const State& s) {
      return s.specific_internal_energy - s.temperature * s.specific_entropy + s.pressure / s.density;
    };
    EXPECT_NEAR(gibbs(low), gibbs(high), 0.2) << T;
  }
}

TEST(SolidTransition, IdentitiesHoldInBothPhasesAndTheirMixture) {
  const TransitionEos eos(iron());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::map<std::string, int> states;
  for (int i = 0; i < 1500; ++i) {
    const double rho = 7600.0 * std::exp(uniform(random) * std::log(1.45));
    const double from = eos.state_at_temperature(rho, 60).specific_internal_energy;
    const double to = eos.state_at_temperature(rho, 1400).specific_internal_energy;
    const double e = from + uniform(random) * (to - from);
    const State s = eos.state(rho, e);
    EXPECT_NEAR(s.specific_internal_energy, e, 1e-9 * std::abs(e) + 1e-3);
    const double defect = check_identities(eos, rho, e).largest();
    if (std::isnan(defect)) continue;  // the stencil leaves the phase
    ++states[std::string(s.phase)];
    EXPECT_LT(defect, 1e-6) << s.phase << " " << rho << " " << s.temperature;
  }
  for (const char* phase : {"low-pressure solid", "high-pressure solid", "two solids"})
    EXPECT_GT(states[phase], 60) << phase;
}

TEST(SolidTransition, BatchesAreStatesAndPhasesMeetWithoutAStep) {
  const TransitionEos eos(iron());
  std::vector<double> rho, e;
  for (int i = 0; i < 150; ++i) {  // more than one chunk, across both edges
    rho.push_back(8300.0 + 6.0 * i);
    e.push_back(60e3 + 500.0 * i);
  }
  rho.push_back(1e5);
  e.push_back(0.0);
  const std::size_t n = rho.size();
  std::vector<double> P(n), T(n), c(n), melted(n), vaporised(n);
  const RangeReport report = eos.evaluate({rho, e, P, T, c, melted, vaporised, {}});
  EXPECT_EQ(report.out_of_range, 1u);
  EXPECT_EQ(report.first, n - 1);
  EXPECT_TRUE(std::isnan(P[n - 1]));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const State s = eos.state(rho[i], e[i]);
    EXPECT_NEAR(P[i], s.pressure, 1e-9 * 160e9) << i;
    EXPECT_NEAR(T[i], s.temperature, 1e-9 * T[i]);
    EXPECT_NEAR(c[i], s.sound_speed, 1e-6 * c[i]) << s.phase;
    EXPECT_EQ(melted[i], 0.0);
    EXPECT_LT(std::abs(P[i] - P[i > 0 ? i - 1 : 0]), 0.3e9) << i;
  }
  EXPECT_THROW(static_cast<void>(eos.state(1e5, 0.0)), StateError);
}

// The shock to the onset of the transition is faster than the one that would jump over it.
TEST(SolidTransition, ShocksSplit) {
  const TransitionEos eos(iron());
  const Hugoniot hugoniot(eos);
  const ShockState onset = hugoniot.at_pressure(12.9e9), beyond = hugoniot.at_pressure(20e9);
  EXPECT_EQ(onset.state.phase, "low-pressure solid");
  EXPECT_EQ(beyond.state.phase, "high-pressure solid");
  EXPECT_GT(onset.shock_velocity, 1.1 * beyond.shock_velocity);
  EXPECT_GT(hugoniot.at_pressure(90e9).shock_velocity, onset.shock_velocity);
}

TEST(SolidTransition, WrongConstantsAreRefusedByName) {
  const auto refusal = [](const SolidTransitionConstants& c) -> std::string {
    try {
      SolidTransition model(c);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  SolidTransitionConstants c = iron();
  std::swap(c.low, c.high);
  EXPECT_NE(refusal(c).find("high_reference_density"), std::string::npos) << refusal(c);
  c = iron();
  c.high.reference_density = 7900.0;
  c.high.bulk_modulus = 400e9;  // at the transition it is the less dense one
  EXPECT_NE(refusal(c).find("must be the denser one"), std::string::npos) << refusal(c);
}

}  // namespace
}  // namespace whipple::eos::test

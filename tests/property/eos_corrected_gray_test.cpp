// SPDX-License-Identifier: BSD-3-Clause
// GRAY with corrected free energies (docs/theory/gray.md, section 11): splines, identities, phases, limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "eos/identities.hpp"
#include "eos/models/three_phase_model.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

using CorrectedEos = ModelEquationOfState<CorrectedGray>;

/// A smooth wave of coefficients, in units of C^2.
CorrectionConstants wave(double from, double to, std::size_t volumes, double size, double phase) {
  CorrectionConstants c{from, to, 2000.0, 9, {}};
  for (std::size_t i = 0; i < volumes; ++i) {
    for (std::int64_t k = 0; k < c.temperatures; ++k) {
      const auto x = static_cast<double>(i), y = static_cast<double>(k);
      c.coefficients.push_back(size * std::sin(0.25 * x + phase) * std::cos(0.3 * y - phase));
    }
  }
  return c;
}

/// @param size  of both corrections in units of C^2; 0: GRAY
CorrectedGrayConstants corrected_copper(double size) {
  return {copper(MeltingTransition::equilibrium), wave(0.55, 1.3, 16, size, 0.3),
          wave(0.55, 40.0, 30, size, 1.1)};
}

TEST(FreeEnergySpline, DerivativesAreThoseOfTheFunctionAndItsFunctionals) {
  const FreeEnergyGrid grid{0.5, 3.0, 1500.0, 12, 9};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> coefficients(grid.size());
  for (double& c : coefficients) c = uniform(random);
  const FreeEnergySpline f(grid, coefficients);
  for (int i = 0; i < 200; ++i) {
    const double V = std::exp(std::log(0.3) + (i % 20) * std::log(20.0) / 20), T = 20.0 + 37.0 * i;
    const FreeEnergyTerms at = f(V, T);
    const double h = 2e-3 * V, d = 2e-3 * T;
    // Fourth-order differences of splines of degree five.
    const auto slope = [](const auto& g, double step) {
      return (8 * (g(step) - g(-step)) - (g(2 * step) - g(-2 * step))) / (12 * step);
    };
    const double tolerance = 2e-6;
    EXPECT_NEAR(at.F_V, slope([&](double s) { return f(V + s, T).F; }, h), tolerance * 30) << V << " " << T;
    EXPECT_NEAR(at.F_T * T, slope([&](double s) { return f(V, T + s).F; }, d) * T, tolerance)
        << V << " " << T;
    EXPECT_NEAR(at.F_VV, slope([&](double s) { return f(V + s, T).F_V; }, h), tolerance * 1000);
    EXPECT_NEAR(at.F_VT * T, slope([&](double s) { return f(V, T + s).F_V; }, d) * T, tolerance * 30);
    EXPECT_NEAR(at.F_TT * T * T, slope([&](double s) { return f(V, T + s).F_T; }, d) * T * T, tolerance * 10);
    // A functional is the same sum with the roles of coefficients and functions exchanged.
    const FreeEnergyTerms weights{0.3, -0.2, 50.0, 0.1, 20.0, 1e4};
    std::vector<double> row(grid.size());
    FreeEnergySpline::add_functional(grid, V, T, weights, row);
    double sum = 0;
    for (std::size_t k = 0; k < row.size(); ++k) sum += row[k] * coefficients[k];
    const double direct = weights.F * at.F + weights.F_V * at.F_V + weights.F_T * at.F_T +
                          weights.F_VV * at.F_VV + weights.F_VT * at.F_VT + weights.F_TT * at.F_TT;
    EXPECT_NEAR(sum, direct, 1e-12 * (1 + std::abs(direct)));
  }
  // Beyond the grid there is no pressure, and for hot material no entropy.
  EXPECT_NEAR(f(0.5 * std::exp(-3.1 * grid.volume_step()), 700.0).F_V, 0.0, 1e-14);
  EXPECT_NEAR(f(3.0 * std::exp(3.1 * grid.volume_step()), 700.0).F_V, 0.0, 1e-14);
  EXPECT_LT(std::abs(f(1.0, 1e9).F_T * 1e9), 1e-3);
}

TEST(CorrectedGray, WithoutCorrectionIsGray) {
  const CorrectedEos corrected(corrected_copper(0.0));
  const GrayEos gray(copper(MeltingTransition::equilibrium));
  EXPECT_NEAR(corrected.maximum_density(), gray.maximum_density(), 1e-6 * gray.maximum_density());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 400; ++i) {
    const double rho = gray.reference_density() / std::exp(std::log(0.5) + uniform(random) * std::log(100.0));
    const double T = 60 * std::exp(uniform(random) * std::log(400.0));
    const State a = corrected.state_at_temperature(rho, T), b = gray.state_at_temperature(rho, T);
    EXPECT_EQ(a.phase, b.phase) << rho << " " << T;
    const double stiffness = rho * b.sound_speed * b.sound_speed + 1e8;
    EXPECT_NEAR(a.pressure, b.pressure, 1e-9 * stiffness) << rho << " " << T;
    EXPECT_NEAR(a.specific_internal_energy, b.specific_internal_energy, 1e-9 * 5e6);
    EXPECT_NEAR(a.specific_entropy, b.specific_entropy, 1e-9 * 1e3);
    EXPECT_NEAR(a.sound_speed, b.sound_speed, 1e-7 * b.sound_speed + 1e-4) << a.phase << rho << " " << T;
    EXPECT_NEAR(a.melted_fraction, b.melted_fraction, 1e-8);
    EXPECT_NEAR(a.vaporised_fraction, b.vaporised_fraction, 1e-8);
    const State back = corrected.state(rho, a.specific_internal_energy);
    EXPECT_NEAR(back.temperature, T, 1e-9 * T) << back.phase << " " << rho;
  }
}

// One free energy per phase: the identities hold as for GRAY, whatever the correction.
TEST(CorrectedGray, IdentitiesHoldInEveryPhase) {
  const CorrectedEos eos(corrected_copper(8e-4));
  const GrayEos gray(copper(MeltingTransition::equilibrium));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::map<std::string, int> states;
  double moved = 0;
  for (int i = 0; i < 2500; ++i) {
    const double ratio = std::exp(std::log(0.56) + uniform(random) * std::log(20.0 / 0.56));
    const double rho = eos.reference_density() / ratio;
    const double from = eos.state_at_temperature(rho, 100).specific_internal_energy;
    const double to = eos.state_at_temperature(rho, 25000).specific_internal_energy;
    const double e = from + std::pow(uniform(random), 2) * (to - from);
    const State s = eos.state(rho, e);
    const IdentityDefects defects = check_identities(eos, rho, e);
    ++states[std::string(s.phase)];
    moved = std::max(moved, std::abs(s.pressure - gray.state(rho, e).pressure) / 1e9);
    EXPECT_LT(defects.largest(), 1e-6) << s.phase << " V/V0 " << ratio << " T " << s.temperature << ": c "
                                       << defects.sound_speed << " S,V " << defects.entropy_volume;
  }
  for (const char* phase : {"solid", "melting", "liquid", "hot liquid", "vapour", "hot vapour"})
    EXPECT_GT(states[phase], 20) << phase;
  EXPECT_GT(moved, 0.5);  // GPa
}

TEST(CorrectedGray, PhasesMeetWithoutAStep) {
  const CorrectedEos eos(corrected_copper(8e-4));
  const GrayMeltingCurve& curve = eos.underlying().melting_curve();
  const CorrectedGraySurfaces& surfaces = eos.underlying().surfaces();
  for (const double share : {0.1, 0.3, 0.5, 0.7}) {
    const double T =
        curve.coldest().temperature + share * (curve.hottest().temperature - curve.coldest().temperature);
    const auto t = curve.at_temperature(T);
    const GrayPoint s = surfaces.solid(t.solid_volume, T), l = surfaces.fluid(t.liquid_volume, T);
    EXPECT_NEAR(s.pressure, l.pressure, 1e-5 * 140e9) << T;
    EXPECT_NEAR(s.gibbs(t.solid_volume, T), l.gibbs(t.liquid_volume, T), 1e-4 * T * (l.entropy - s.entropy));
    const double rho = 2 / (t.solid_volume + t.liquid_volume);
    for (const double edge : {curve.solidus(1 / rho), curve.liquidus(1 / rho)}) {
      const State below = eos.state_at_temperature(rho, edge * (1 - 1e-9));
      const State above = eos.state_at_temperature(rho, edge * (1 + 1e-9));
      EXPECT_NE(below.phase, above.phase);
      EXPECT_NEAR(below.pressure, above.pressure, 1e-5 * 140e9);
      EXPECT_NEAR(below.specific_internal_energy, above.specific_internal_energy, 20.0);
    }
  }
  // The dome is that of the corrected fluid.
  const Saturation saturation = eos.underlying().dome().at_temperature(4000).value();
  const GrayPoint l = surfaces.fluid(saturation.liquid_volume, 4000),
                  v = surfaces.fluid(saturation.vapour_volume, 4000);
  EXPECT_NEAR(l.pressure, v.pressure, 1e-6 * 140e9);
  EXPECT_NEAR(l.gibbs(saturation.liquid_volume, 4000), v.gibbs(saturation.vapour_volume, 4000), 1.0);
}

TEST(CorrectedGray, BatchesAreStatesAndLimitsAreCounted) {
  const CorrectedEos eos(corrected_copper(8e-4));
  const double rho0 = eos.reference_density(), infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> rho = {rho0,       1.3 * rho0, 0.9 * rho0, 0.85 * rho0,
                                   0.1 * rho0, 1e3 * rho0, rho0,       1.1 * rho0};
  const std::vector<double> e = {0.0, 1.5e6, 0.6e6, 0.2e6, 6e6, 0.0, infinity, -5e6};
  std::vector<double> P(8), T(8), c(8), melted(8), vaporised(8);
  const RangeReport report = eos.evaluate({rho, e, P, T, c, melted, vaporised, {}});
  EXPECT_EQ(report.out_of_range, 2u);
  EXPECT_EQ(report.first, 5u);
  EXPECT_EQ(report.bound, "density above the compression limit of the cold curve");
  EXPECT_EQ(report.below_cold_curve, 1u);
  EXPECT_EQ(T[7], 1.0);
  for (std::size_t i = 0; i < 5; ++i) {
    const State s = eos.state(rho[i], e[i]);
    EXPECT_EQ(P[i], s.pressure);
    EXPECT_EQ(T[i], s.temperature);
    EXPECT_EQ(c[i], s.sound_speed);
    EXPECT_EQ(melted[i], s.melted_fraction);
    EXPECT_EQ(vaporised[i], s.vaporised_fraction);
  }
  EXPECT_TRUE(std::isnan(P[5]) && std::isnan(T[6]) && std::isnan(melted[5]));
  EXPECT_THROW(static_cast<void>(eos.state(1e3 * rho0, 0.0)), StateError);
}

std::string refusal(const CorrectedGrayConstants& constants) {
  try {
    CorrectedGray model(constants);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(CorrectedGray, WrongConstantsAreRefusedByName) {
  CorrectedGrayConstants c = corrected_copper(0.0);
  c.gray.melting = MeltingTransition::band;
  EXPECT_NE(refusal(c).find("melting must be \"equilibrium\""), std::string::npos);
  c = corrected_copper(0.0);
  c.common.coefficients.pop_back();
  EXPECT_NE(refusal(c).find("no whole rows of 9 functions"), std::string::npos) << refusal(c);
  c = corrected_copper(0.0);
  std::swap(c.fluid.least_volume_ratio, c.fluid.greatest_volume_ratio);
  EXPECT_NE(refusal(c).find("the volumes must rise"), std::string::npos) << refusal(c);
  c = corrected_copper(0.0);  // a melt without entropy of fusion left
  for (double& x : c.fluid.coefficients) x = 0.05;
  EXPECT_NE(refusal(c).find("no equal free energies"), std::string::npos) << refusal(c);
}

}  // namespace
}  // namespace whipple::eos::test

// SPDX-License-Identifier: BSD-3-Clause
// The fit finds the constants that the data were made of, and its errors are those that it makes.
#include "tests/property/fit_recovery.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "eos/models/gray_melting_curve.hpp"

namespace whipple::fit {
namespace {

using testing::fitted;
using testing::Noise;
using testing::noise_only;
using testing::SyntheticStore;
using testing::true_constants;
using testing::values;

// Without noise the constants come back.
TEST(FitRecovery, ExactDataGiveTheirConstants) {
  const eos::GrayConstants truth = true_constants();
  Noise noise;
  noise.silent = true;
  const SyntheticStore store(truth, noise, 1);
  const GrayFit fit = fit_gray(store.points, noise_only(), "synthetic");
  const std::vector<double> expected = values(truth);
  EXPECT_EQ(fit.fitted_names, fitted);
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    EXPECT_NEAR(fit.value(fitted[i]), expected[i], 1e-6 * expected[i]) << fitted[i];
  }
  EXPECT_LT(fit.chi_squared, 1e-6);
}

// Errors of pressure and energy that are wholly shared (two proportional series) leave a matrix of errors
// that can be inverted: the constants come back from exact data, and from noise as well as with half of it
// shared.
TEST(FitRecovery, WhollyCorrelatedErrorsAreFitted) {
  const eos::GrayConstants truth = true_constants();
  const std::vector<double> expected = values(truth);
  for (const double correlation : {1.0, -1.0}) {
    Noise noise;
    noise.correlation = correlation;
    noise.silent = true;
    const GrayFit exact = fit_gray(SyntheticStore(truth, noise, 1).points, noise_only(), "synthetic");
    for (std::size_t i = 0; i < fitted.size(); ++i) {
      EXPECT_NEAR(exact.value(fitted[i]), expected[i], 1e-6 * expected[i]) << fitted[i] << " " << correlation;
    }
    noise.silent = false;
    const GrayFit noisy = fit_gray(SyntheticStore(truth, noise, 5).points, noise_only(), "synthetic");
    for (std::size_t i = 0; i < fitted.size(); ++i) {
      const auto place = static_cast<Eigen::Index>(i);
      const double error = std::sqrt(noisy.covariance(place, place));
      EXPECT_GT(error, 0.0) << fitted[i];
      EXPECT_NEAR(noisy.value(fitted[i]), expected[i], 4.0 * error) << fitted[i];
    }
  }
}

// The isochoric melting law is the other reading of T_m0: same data, and the Lindemann curve through them.
TEST(FitRecovery, IsochoricMeltingFollowsTheSolidVolume) {
  eos::GrayConstants truth = true_constants();
  truth.melting = eos::MeltingTransition::isochoric;  // T1 = T_m(V) in the synthetic coexistence points
  Noise noise;
  noise.silent = true;
  const SyntheticStore store(truth, noise, 1);
  FitSettings settings = noise_only();
  settings.melting = eos::MeltingTransition::isochoric;
  const GrayFit fit = fit_gray(store.points, settings, "synthetic");
  EXPECT_NEAR(fit.value("melting_temperature"), truth.melting_temperature, 0.01);
  ASSERT_TRUE(fit.isochoric_melting_temperature.has_value());
  EXPECT_NEAR(*fit.isochoric_melting_temperature, truth.melting_temperature, 0.01);
  // Read as a band, the same points need a higher T_m0: half the band above.
  settings.melting = eos::MeltingTransition::band;
  const GrayFit band = fit_gray(store.points, settings, "synthetic");
  EXPECT_GT(band.value("melting_temperature"), truth.melting_temperature + 50.0);
  // The constants of the other law shift gamma a little, and the reading of the points with it.
  EXPECT_NEAR(*band.isochoric_melting_temperature, truth.melting_temperature, 0.1);
}

// The solid of a coexistence point is in equilibrium with a liquid of another volume: the constants come
// back, and the complete model melts at the points' own temperatures and pressures.
TEST(FitRecovery, EquilibriumMeltingFollowsTheCommonTangent) {
  eos::GrayConstants truth = true_constants();
  truth.melting = eos::MeltingTransition::equilibrium;
  Noise noise;
  noise.silent = true;
  const SyntheticStore store(truth, noise, 1);
  FitSettings settings = noise_only();
  settings.melting = eos::MeltingTransition::equilibrium;
  const GrayFit fit = fit_gray(store.points, settings, "synthetic");
  EXPECT_NEAR(fit.value("melting_temperature"), truth.melting_temperature, 0.01);
  EXPECT_EQ(fit.gray.melting, eos::MeltingTransition::equilibrium);
  const eos::GrayFreeEnergy surface(truth);
  const eos::GrayMeltingCurve curve(surface);
  int points = 0;
  for (const md::PointRecord& point : store.points) {
    if (point.protocol != "coexistence") continue;
    const double T = point.results.at("melting_temperature").value;
    EXPECT_NEAR(curve.at_pressure(point.conditions.at("pressure")).temperature, T, 1e-6 * T);
    ++points;
  }
  EXPECT_GT(points, 3);
}

// With model errors the total error exceeds the noise, and data that obey the laws leave chi^2 below its
// expectation.
TEST(FitRecovery, ModelErrorsWidenTheErrors) {
  const SyntheticStore store(true_constants(), Noise{}, 3);
  FitSettings settings = noise_only();
  settings.model_errors = ModelErrors{};
  const GrayFit fit = fit_gray(store.points, settings, "synthetic");
  for (const std::string& name : fitted) {
    EXPECT_GT(fit.constant(name).error, fit.constant(name).statistical_error) << name;
  }
  EXPECT_LT(fit.chi_squared, fit.degrees_of_freedom);
  // A deviation common to each isochore does not average out over its temperatures: 2 % of gamma per isochore
  // with six isochores leaves about 2 %/sqrt(6) of gamma0.
  EXPECT_GT(fit.constant("gruneisen").error, 0.5 * 0.02 * fit.value("gruneisen") / std::sqrt(6.0));
}

// The window of particle velocities decides which states count for C and S, and the other windows are
// reported.
TEST(FitRecovery, WindowSelectsHugoniotStates) {
  const SyntheticStore store(true_constants(), Noise{}, 4);
  FitSettings settings = noise_only();
  settings.least_particle_velocity = 0.0;
  settings.most_particle_velocity = 1000.0;
  const GrayFit low = fit_gray(store.points, settings, "synthetic");
  ASSERT_GE(low.windows.size(), 3u);
  const auto states = std::count_if(low.residuals.begin(), low.residuals.end(),
                                    [](const Residual& r) { return r.quantity == "shock_velocity"; });
  EXPECT_EQ(states, low.windows.front().states);
  for (const Residual& residual : low.residuals) {
    if (residual.quantity == "shock_velocity") {
      EXPECT_LE(residual.abscissa, 1000.0);
    }
  }
  const GrayFit wide = fit_gray(store.points, noise_only(), "synthetic");
  EXPECT_LT(wide.constant("hugoniot_slope").error, low.constant("hugoniot_slope").error);
}

// Superheated states are left out: they would carry a law that the stable solid does not follow.
TEST(FitRecovery, SuperheatedStatesAreLeftOut) {
  const eos::GrayConstants truth = true_constants();
  SyntheticStore store(truth, Noise{}, 5);
  const GrayFit before = fit_gray(store.points, noise_only(), "synthetic");
  // At 2300 K the crystal is superheated, at 1500 K one has melted: both off the solid's surface.
  const double v0 = truth.reference_specific_volume;
  const eos::GrayFreeEnergy surface(truth);
  for (const auto& [temperature, solid] : {std::pair(2300.0, 1.0), std::pair(1500.0, 0.0)}) {
    const eos::GrayPoint state = surface.solid(v0, temperature);
    store.add("isochore", {{"specific_volume", v0}, {"temperature", temperature}},
              {{"pressure", {state.pressure + 5e8, 2e7}},
               {"specific_internal_energy", {state.energy - 5.3e6 + 2e4, 400.0}},
               {"solid", {solid, 0.0}}});
  }
  const GrayFit after = fit_gray(store.points, noise_only(), "synthetic");
  EXPECT_EQ(after.superheated_states, before.superheated_states + 1);
  EXPECT_NEAR(after.value("gruneisen"), before.value("gruneisen"), 1e-6);
}

// The complete model reproduces the data that it was fitted to, used or not (isotherms are not used).
TEST(FitRecovery, CompleteModelReproducesTheSimulations) {
  Noise noise;
  noise.straight_hugoniot = false;
  const SyntheticStore store(true_constants(), noise, 6);
  const GrayFit fit = fit_gray(store.points, noise_only(), "synthetic");
  ASSERT_EQ(fit.checks.size(), 6u);
  for (const ModelCheck& check : fit.checks) {
    SCOPED_TRACE(check.quantity);
    EXPECT_GT(check.points, 0);
    EXPECT_LE(std::abs(check.mean), check.rms * (1 + 1e-12));
    if (check.quantity == "isotherm pressure") {
      EXPECT_LT(check.rms, 0.3);  // GPa, of up to 25
    }
    if (check.quantity == "isochore pressure") {
      EXPECT_LT(check.rms, 0.5);  // GPa, of up to 60
    }
    if (check.quantity == "Hugoniot pressure") {
      EXPECT_LT(check.rms, 1.0);  // GPa, of up to 100: noise 0.5 %
    }
    if (check.quantity == "volume at zero pressure") {
      EXPECT_LT(check.rms, 0.05);  // %
    }
    if (check.quantity.starts_with("melting")) {
      EXPECT_LT(check.rms, 30.0);  // K
    }
    if (check.quantity == "latent heat of fusion") {
      EXPECT_LT(check.rms, 3.0);  // %, noise 2
    }
  }
}

}  // namespace
}  // namespace whipple::fit

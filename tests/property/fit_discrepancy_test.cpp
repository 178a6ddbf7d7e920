// SPDX-License-Identifier: BSD-3-Clause
// Errors of the fit where the data do not obey its laws: correlated deviations, their amplitude, the window, and the
// scatter over potentials.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "md_fitting/fit/discrepancy.hpp"
#include "md_fitting/fit/identifiability.hpp"
#include "md_fitting/fit/potential_spread.hpp"
#include "md_fitting/fit/scaled_fit.hpp"
#include "md_fitting/fit/solid_fit.hpp"
#include "md_fitting/fit/structure_limit.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/normal_samples.hpp"
#include "tests/property/fit_recovery.hpp"

namespace whipple::fit {
namespace {

using testing::Noise;
using testing::SyntheticStore;
using testing::true_constants;

constexpr double length = 1000.0;  // m/s, of the deviations drawn below: that of the settings

/// Lets Us leave its straight line by `size` times a smooth function of up with unit variance. The volume is exact:
/// with C + d in place of C, Us and up grow by 1 + d/C.
void bend(std::vector<md::PointRecord>& points, double size, std::uint64_t seed) {
  std::vector<md::PointRecord*> shocks;
  for (md::PointRecord& point : points) {
    if (point.protocol == "hugoniot") shocks.push_back(&point);
  }
  const auto n = static_cast<Eigen::Index>(shocks.size());
  Eigen::MatrixXd covariance(n, n);
  const auto velocity = [&](Eigen::Index i, const char* name) {
    return shocks[static_cast<std::size_t>(i)]->result(name).value;
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      covariance(i, k) = matern(velocity(i, "particle_velocity") - velocity(k, "particle_velocity"), length) *
                         velocity(i, "shock_velocity") * velocity(k, "shock_velocity") * size * size;
    }
  }
  const Eigen::VectorXd deviation = NormalSamples(Eigen::VectorXd::Zero(n), covariance, seed).draw();
  for (Eigen::Index i = 0; i < n; ++i) {
    const double factor = 1.0 + deviation[i] / true_constants().hugoniot_intercept;
    md::PointRecord& point = *shocks[static_cast<std::size_t>(i)];
    point.results.at("shock_velocity").value *= factor;
    point.results.at("particle_velocity").value *= factor;
    point.results.at("pressure").value *= factor * factor;
  }
}

FitSettings one_window(ErrorStructure structure, bool inflation) {
  FitSettings settings;
  settings.electrons = "none";
  settings.windows = WindowChoice::single;
  settings.structure = structure;
  settings.inflation = inflation;
  return settings;
}

/// Noise far below the model errors, as in a store of molecular dynamics.
Noise small_noise() {
  Noise noise;
  noise.shock_pressure = 2e-4;
  noise.pressure = 1e5;
  noise.energy = 10.0;
  return noise;
}

/// The solid alone, which is all that these deviations concern.
struct SolidAlone {
  Observations data;
  SolidModel model;
  SolidConstants start;

  SolidAlone(const std::vector<md::PointRecord>& points, const FitSettings& settings)
      : data(observe(points, settings, {}, "synthetic")) {
    data.isochores.resize(2);  // enough for their constants
    for (Isochore& isochore : data.isochores) isochore.states.resize(3);
    model.free = {Place::volume,    Place::intercept,       Place::slope,
                  Place::gruneisen, Place::gruneisen_slope, Place::anharmonic};
    model.hugoniot = true;
    const double heat_capacity = fixed_solid(data).heat_capacity;
    start = SolidConstants{true_constants()};
    start.heat_capacity = heat_capacity;
  }
};

ScaledFit solid_fit(const std::vector<md::PointRecord>& points, const FitSettings& settings) {
  const SolidAlone solid(points, settings);
  return fit_scaled(solid.data, solid.model, settings, solid.start);
}

/// rms of (C - true C)/error and of S over realisations of the deviation.
std::pair<double, double> pulls(ErrorStructure structure) {
  constexpr int seeds = 40;
  double intercept = 0.0, slope = 0.0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SyntheticStore store(true_constants(), small_noise(), seed);
    bend(store.points, ModelErrors{}.shock_velocity, seed);
    const ScaledFit fit = solid_fit(store.points, one_window(structure, false));
    const eos::GrayConstants& found = fit.constants.gray;
    intercept += std::pow(found.hugoniot_intercept - true_constants().hugoniot_intercept, 2) /
                 fit.covariance(1, 1) / seeds;
    slope +=
        std::pow(found.hugoniot_slope - true_constants().hugoniot_slope, 2) / fit.covariance(2, 2) / seeds;
  }
  return {std::sqrt(intercept), std::sqrt(slope)};
}

// Errors that assume one deviation per state are too small for a smooth deviation; correlated ones are those made.
TEST(FitDiscrepancy, CorrelatedErrorsAreTheErrorsMade) {
  constexpr double three_sigma = 3.0 / 8.9;  // of the rms of 40 normal numbers
  const auto [intercept, slope] = pulls(ErrorStructure::correlated);
  EXPECT_NEAR(intercept, 1.0, three_sigma);
  EXPECT_NEAR(slope, 1.0, three_sigma);
  const auto [lone_intercept, lone_slope] = pulls(ErrorStructure::independent);
  // Least squares in closed form, weighted as if the seven states of the window were independent: 1.27 and 1.10 times
  // the stated errors.
  EXPECT_NEAR(lone_intercept, 1.27, 1.27 * three_sigma);
  EXPECT_NEAR(lone_slope, 1.10, 1.10 * three_sigma);
  EXPECT_GT(lone_intercept, 1.0);
}

TEST(FitDiscrepancy, CorrelationIsThatOfASmoothFunction) {
  EXPECT_DOUBLE_EQ(matern(0.0, 3.0), 1.0);
  EXPECT_DOUBLE_EQ(matern(3.0, 3.0), (1.0 + std::sqrt(3.0)) * std::exp(-std::sqrt(3.0)));
  EXPECT_DOUBLE_EQ(matern(-2.0, 3.0), matern(2.0, 3.0));
  EXPECT_LT(matern(30.0, 3.0), 1e-5);
  // Smooth at zero distance: the first derivative vanishes.
  EXPECT_NEAR((1.0 - matern(1e-4, 1.0)) / 1e-4, 0.0, 1e-3);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(6, 6);
  const std::vector<Eigen::Index> rows = {5, 4, 0};
  const std::vector<double> place = {0.0, 0.3, 1.0};
  add_discrepancy(
      {{2.0, 3.0, 1.0}, [&](std::size_t i, std::size_t k) { return matern(place[i] - place[k], 1.0); }}, rows,
      covariance);
  EXPECT_DOUBLE_EQ(covariance(5, 5), 4.0);
  EXPECT_DOUBLE_EQ(covariance(4, 5), 6.0 * matern(0.3, 1.0));
  EXPECT_DOUBLE_EQ(covariance(0, 4), 3.0 * matern(0.7, 1.0));
  EXPECT_EQ(covariance.row(2).norm(), 0.0);
  EXPECT_TRUE(covariance.isApprox(covariance.transpose()));
}

const ChiSquaredPart& part(const Fit& fit, const std::string& quantity) {
  return *std::ranges::find(fit.chi_squared_parts, quantity, &ChiSquaredPart::quantity);
}

// Deviations five times the stated ones are found by their chi^2, per kind of data; no data lower the stated errors.
TEST(FitDiscrepancy, AmplitudesFollowChiSquared) {
  constexpr int seeds = 12;
  constexpr double wanted = 5.0;
  double mean = 0.0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SyntheticStore store(true_constants(), small_noise(), seed);
    bend(store.points, wanted * ModelErrors{}.shock_velocity, 100 + seed);
    const ModelScale scale = solid_fit(store.points, one_window(ErrorStructure::correlated, true)).scale;
    mean += std::pow(scale.of(DataKind::shock), 2) / seeds;
    EXPECT_EQ(scale.of(DataKind::isochore), 1.0) << seed;  // these obey their laws
  }
  // f^2 of a window of seven states, of which two constants take as many: chi^2 of five, the mean over twelve.
  EXPECT_NEAR(std::sqrt(mean), wanted, 3.0 * wanted / std::sqrt(2.0 * 5.0 * seeds));

  Noise silent;
  silent.silent = true;
  const GrayFit exact = fit_gray(SyntheticStore(true_constants(), silent, 1).points,
                                 one_window(ErrorStructure::correlated, true), "synthetic");
  for (const ChiSquaredPart& one : exact.chi_squared_parts) EXPECT_EQ(one.inflation, 1.0) << one.quantity;
}

// chi^2 of the scaled kind is its redundancy: the factor is the solution of that equation, not one step towards it.
TEST(FitDiscrepancy, ScaledErrorsMakeChiSquaredItsRedundancy) {
  SyntheticStore store(true_constants(), small_noise(), 3);
  // Melting data would bear on C and S as well.
  std::erase_if(store.points, [](const md::PointRecord& point) { return point.protocol == "coexistence"; });
  bend(store.points, 0.03, 7);
  const GrayFit fit = fit_gray(store.points, one_window(ErrorStructure::correlated, true), "synthetic");
  const ChiSquaredPart& shocks = part(fit, "shock velocity");
  ASSERT_GT(shocks.inflation, 2.0);
  // V0 is fixed by its own datum: C and S take two of the data.
  EXPECT_NEAR(shocks.chi_squared, shocks.data - 2.0, 0.05);
}

// A window of particle velocities that no shock has is not fitted, and the message says so.
TEST(FitWindows, TheOnlyWindowNeedsStates) {
  FitSettings settings = one_window(ErrorStructure::correlated, true);
  const SolidAlone solid(SyntheticStore(true_constants(), small_noise(), 1).points, settings);
  settings.least_particle_velocity = 9e4, settings.most_particle_velocity = 1e5;
  try {
    (void)fit_windows(solid.data, solid.model, settings, solid.start);
    FAIL() << "fitted without states";
  } catch (const StateError& error) {
    EXPECT_NE(std::string(error.what()).find("0 states"), std::string::npos) << error.what();
  }
}

// The mean over windows and its variance are those of a mixture of the windows' distributions.
TEST(FitWindows, MeanAndVarianceAreThoseOfTheMixture) {
  SolidModel model;
  model.free = {Place::intercept, Place::slope};
  std::vector<WindowFit> windows(2);
  windows[0].weight = 0.25;
  windows[1].weight = 0.75;
  for (std::size_t i = 0; i < 2; ++i) {
    windows[i].fit.constants.gray.hugoniot_intercept = i == 0 ? 4000.0 : 3800.0;
    windows[i].fit.constants.gray.hugoniot_slope = i == 0 ? 1.4 : 1.5;
    windows[i].fit.covariance = (i == 0 ? 100.0 : 400.0) * Eigen::Matrix2d::Identity();
    windows[i].fit.statistical_covariance = (i == 0 ? 4.0 : 8.0) * Eigen::Matrix2d::Identity();
  }
  const ScaledFit mean = mean_of(windows, model);
  EXPECT_DOUBLE_EQ(mean.constants.gray.hugoniot_intercept, 3850.0);
  EXPECT_DOUBLE_EQ(mean.constants.gray.hugoniot_slope, 1.475);
  // Within 0.25 100 + 0.75 400, between 0.25 0.75 200^2; the covariance between C and S has the second part alone.
  EXPECT_DOUBLE_EQ(mean.covariance(0, 0), 325.0 + 7500.0);
  EXPECT_NEAR(mean.covariance(0, 1), -0.25 * 0.75 * 200.0 * 0.1, 1e-9);
  EXPECT_DOUBLE_EQ(mean.statistical_covariance(0, 0), 7.0);
}

TEST(FitWindows, ScatterOfTheWindowsIsPartOfTheErrors) {
  SyntheticStore store(true_constants(), small_noise(), 2);
  bend(store.points, 0.01, 11);
  FitSettings settings = one_window(ErrorStructure::correlated, true);
  const GrayFit single = fit_gray(store.points, settings, "synthetic");
  settings.windows = WindowChoice::averaged;
  const GrayFit averaged = fit_gray(store.points, settings, "synthetic");
  ASSERT_GE(averaged.windows.size(), 4u);
  double weights = 0.0, intercept = 0.0, between = 0.0;
  for (const WindowResult& window : averaged.windows) {
    weights += window.weight;
    intercept += window.weight * window.intercept;
  }
  for (const WindowResult& window : averaged.windows) {
    between += window.weight * std::pow(window.intercept - intercept, 2);
  }
  EXPECT_NEAR(weights, 1.0, 1e-12);
  const Constant& c = averaged.constant("hugoniot_intercept");
  EXPECT_NEAR(c.value, intercept, 1e-6 * intercept);  // rounded as in a file
  EXPECT_GT(c.error, std::sqrt(between));
  EXPECT_GT(between, 0.0);
  EXPECT_EQ(single.windows.front().weight, 1.0);
  EXPECT_NEAR(single.value("hugoniot_intercept"), single.windows.front().intercept, 1e-6 * intercept);
}

/// Multiplies Us, with up, of the strongest shock.
void spoil_last_shock(std::vector<md::PointRecord>& points, double factor) {
  const auto last = std::find_if(points.rbegin(), points.rend(),
                                 [](const md::PointRecord& point) { return point.protocol == "hugoniot"; });
  for (const char* name : {"shock_velocity", "particle_velocity"}) last->results.at(name).value *= factor;
}

// Windows that hold a state no line through the others comes near are left out, the fit's own among them.
TEST(FitWindows, OneThatDoesNotSettleIsLeftOut) {
  SyntheticStore store(true_constants(), small_noise(), 2);
  std::erase_if(store.points, [](const md::PointRecord& point) { return point.protocol == "coexistence"; });
  spoil_last_shock(store.points, 0.8);
  FitSettings settings = one_window(ErrorStructure::correlated, true);
  settings.windows = WindowChoice::averaged;
  const GrayFit fit = fit_gray(store.points, settings, "synthetic");
  ASSERT_EQ(fit.windows.size(), 1u);
  EXPECT_EQ(fit.windows.front().most, 1000.0);
  EXPECT_EQ(fit.windows.front().weight, 1.0);
  EXPECT_EQ(fit.settings.least_particle_velocity, 0.0);  // residuals and chi^2 are those of the window left
  EXPECT_EQ(part(fit, "shock velocity").data, 6);
  EXPECT_NEAR(fit.value("hugoniot_slope"), true_constants().hugoniot_slope, 0.01);
  ASSERT_EQ(fit.remarks.size(), 3u);
  EXPECT_EQ(fit.remarks.front().rfind("particle velocities of 0.30 ... 2.50 km/s (7 states) left out: ", 0),
            0u)
      << fit.remarks.front();

  settings.windows = WindowChoice::single;
  EXPECT_THROW(fit_gray(store.points, settings, "synthetic"), StateError);
  settings.windows = WindowChoice::averaged;
  spoil_last_shock(store.points, 0.5 / 0.8);  // now among the weakest: in every window
  try {
    fit_gray(store.points, settings, "synthetic");
    FAIL() << "no window settles";
  } catch (const StateError& error) {
    EXPECT_EQ(
        std::string(error.what()).rfind("the fit settles in none of 3 windows of particle velocities: ", 0),
        0u)
        << error.what();
  }
}

/// A fit of two constants with a covariance.
Fit two_constants(double first, double second, const Eigen::Matrix2d& covariance) {
  Fit fit;
  fit.element = "Cu";
  fit.fitted_names = {"hugoniot_intercept", "hugoniot_slope"};
  fit.covariance = covariance;
  for (std::size_t k = 0; k < 2; ++k) {
    Constant constant;
    constant.name = fit.fitted_names[k];
    constant.unit = k == 0 ? "m/s" : "";
    constant.value = k == 0 ? first : second;
    constant.origin = Origin::fitted;
    constant.error = std::sqrt(covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)));
    fit.constants.push_back(constant);
  }
  return fit;
}

TEST(FitIdentifiability, EigenvaluesAndErrorsOfAKnownCovariance) {
  // Relative errors of 1 % and 2 % with a correlation of -0.6.
  Eigen::Matrix2d covariance;
  covariance << 1600.0, -0.6 * 40.0 * 0.03, -0.6 * 40.0 * 0.03, 0.0009;
  const Fit fit = two_constants(4000.0, 1.5, covariance);
  const Identifiability result = identifiability(fit);
  // Inverse of {{1e-4, -1.2e-4}, {-1.2e-4, 4e-4}}: trace and determinant.
  const double determinant = 1e-4 * 4e-4 - 1.44e-8;
  EXPECT_NEAR(result.eigenvalues.sum(), 5e-4 / determinant, 1e-6 / determinant);
  EXPECT_NEAR(result.eigenvalues.prod(), 1.0 / determinant, 1e-6 / determinant);
  EXPECT_LT(result.eigenvalues[0], result.eigenvalues[1]);
  EXPECT_NEAR(result.constants[0].relative_error, 0.01, 1e-12);
  EXPECT_NEAR(result.constants[0].conditional_error, 40.0 * 0.8, 1e-9);  // (1 - 0.6^2)^(1/2)
  EXPECT_NEAR(result.constants[1].inflation, 1.25, 1e-9);
  EXPECT_NEAR(result.constants[1].correlation, -0.6, 1e-12);
  EXPECT_NE(
      identifiability_text(fit).find("hugoniot_slope: 1.2, -0.60 with hugoniot_intercept; known to 2 %"),
      std::string::npos)
      << identifiability_text(fit);
  const Fit lost = two_constants(4000.0, 0.02, covariance);
  EXPECT_NE(identifiability_text(lost).find("not distinguished from zero"), std::string::npos);
}

TEST(PotentialSpread, IsTheScatterOfTheirConstants) {
  const Eigen::Matrix2d covariance = Eigen::Vector2d(1.0, 1e-6).asDiagonal();
  std::vector<Fit> fits = {two_constants(3900.0, 1.5, covariance), two_constants(4000.0, 1.3, covariance),
                           two_constants(3800.0, 1.4, covariance)};
  const std::vector<const Fit*> all = {&fits[0], &fits[1], &fits[2]};
  const PotentialSpread spread = potential_spread(all).value();
  EXPECT_DOUBLE_EQ(spread.mean[0], 3900.0);
  EXPECT_DOUBLE_EQ(spread.covariance(0, 0), 10000.0);
  EXPECT_NEAR(spread.covariance(1, 1), 0.01, 1e-15);
  EXPECT_NEAR(spread.covariance(0, 1), 0.5 * (100.0 * -0.1 + 0.0), 1e-12);
  EXPECT_FALSE(potential_spread(std::span(all).first(1)).has_value());
  // A constant that one of them does not determine is not compared.
  fits[1].fitted_names.pop_back();
  EXPECT_EQ(potential_spread(all)->names, std::vector<std::string>{"hugoniot_intercept"});
}

// Where hcp crosses fcc along the cold curve, linear between the volumes; tension and other structures do not count.
TEST(StructureLimit, IsWhereAnotherStructureHasLessEnergy) {
  Noise silent;
  silent.silent = true;
  SyntheticStore store(true_constants(), silent, 1);
  EXPECT_FALSE(structure_limit(store.points).has_value());
  const double v0 = true_constants().reference_specific_volume;
  const auto cold = [&](double ratio, double pressure, double hcp, double bcc) {
    store.add("cold_curve", {{"specific_volume", ratio * v0}, {"temperature", 0.0}},
              {{"pressure", {pressure, 0.0}},
               {"specific_internal_energy", {-5e6, 0.0}},
               {"hcp_specific_internal_energy", {-5e6 + hcp, 0.0}},
               {"bcc_specific_internal_energy", {-5e6 + bcc, 0.0}}});
  };
  cold(1.1, -10e9, -500.0, 900.0);
  cold(1.0, 0.0, 2000.0, 4000.0);
  cold(0.9, 20e9, 1000.0, 2000.0);
  EXPECT_FALSE(structure_limit(store.points).has_value());
  cold(0.8, 60e9, -3000.0, 1000.0);
  cold(0.7, 120e9, -9000.0, -1000.0);
  const StructureLimit limit = structure_limit(store.points).value();
  EXPECT_EQ(limit.structure, "hcp");
  EXPECT_NEAR(limit.pressure, 30e9, 1.0);
  EXPECT_NEAR(limit.volume, 0.875 * v0, 1e-9 * v0);
  const GrayFit fit = fit_gray(store.points, testing::noise_only(), "synthetic");
  // Hugoniot states of V/V0 = 0.85 and less, two isochores.
  ASSERT_FALSE(fit.remarks.empty());
  EXPECT_NE(fit.remarks.front().find("beyond 30 GPa (V/V0 = 0.875) the hcp crystal"), std::string::npos);
  EXPECT_NE(fit.remarks.front().find(": 5 Hugoniot states and "), std::string::npos) << fit.remarks.front();
}

}  // namespace
}  // namespace whipple::fit

// SPDX-License-Identifier: BSD-3-Clause
// Coverage of bands: of data that are drawn from the stated distribution, and of data that are not.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "eos/experiments/calibration.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/mie_gruneisen.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos::experiments {
namespace {

constexpr double C = 3940.0, S = 1.49, sigma_C = 60.0, sigma_S = 0.03, noise = 40.0;

std::unique_ptr<EquationOfState> model(double intercept, double slope) {
  MieGruneisenConstants constants;
  constants.reference_density = 8930.0;
  constants.hugoniot_intercept = intercept;
  constants.hugoniot_slope = slope;
  constants.gruneisen = 2.0;
  constants.heat_capacity = 390.0;
  constants.reference_temperature = 293.0;
  return std::make_unique<ModelEquationOfState<MieGruneisen>>(constants);
}

/// A material that is drawn from the distribution, and shocks in it that were measured with noise.
Experiment measured(double intercept, double slope, std::mt19937_64& generator) {
  constexpr int points = 24;
  std::normal_distribution<double> normal;
  Experiment experiment;
  experiment.kind = ExperimentKind::shock_velocity;
  for (int i = 1; i <= points; ++i) {
    const double up = 100.0 * i;
    experiment.abscissa.push_back(up);
    experiment.ordinate.push_back(intercept + slope * up + noise * normal(generator));
    experiment.lines.push_back(i);
    experiment.initial_density.push_back(std::numeric_limits<double>::quiet_NaN());
    experiment.porosity.push_back(std::numeric_limits<double>::quiet_NaN());
    experiment.temperatures.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  return experiment;
}

struct Samples {
  std::vector<std::unique_ptr<EquationOfState>> models;
  std::vector<std::pair<const EquationOfState*, State>> all;
};

Samples samples_of(double intercept_error, double slope_error, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  Samples samples;
  for (int i = 0; i < 60; ++i) {
    const double first = normal(generator), second = normal(generator);
    samples.models.push_back(model(C + intercept_error * first, S + slope_error * second));
    const EquationOfState& eos = *samples.models.back();
    samples.all.emplace_back(&eos, eos.state_at_temperature(eos.reference_density(), 293.0));
  }
  return samples;
}

/// Mean coverage over materials drawn from the distribution, with bands of `factor` times its errors.
std::array<double, coverage_levels.size()> mean_coverage(double factor) {
  constexpr int materials = 60;
  std::mt19937_64 generator(4);
  std::normal_distribution<double> normal;
  const Samples samples = samples_of(factor * sigma_C, factor * sigma_S, generator);
  const auto central = model(C, S);
  const State initial = central->state_at_temperature(central->reference_density(), 293.0);
  std::array<double, coverage_levels.size()> mean{};
  for (int i = 0; i < materials; ++i) {
    const double first = normal(generator), second = normal(generator);
    const Experiment experiment = measured(C + sigma_C * first, S + sigma_S * second, generator);
    const Calibration result = calibrate(*central, initial, samples.all, experiment);
    EXPECT_EQ(result.points, 24);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += result.coverage[k] / materials;
  }
  return mean;
}

// Points of one material are off together: the mean over 60 materials is known to about (p (1 - p)/60)^(1/2).
TEST(Calibration, DataOfTheStatedDistributionAreCoveredAsStated) {
  const auto mean = mean_coverage(1.0);
  for (std::size_t k = 0; k < mean.size(); ++k) {
    const double p = coverage_levels[k];
    EXPECT_NEAR(mean[k], p, 3.0 * std::sqrt(p * (1.0 - p) / 60.0)) << p;
  }
}

TEST(Calibration, BandsThatAreTooNarrowOrTooWideAreSeen) {
  constexpr std::size_t level_95 = 4;
  EXPECT_LT(mean_coverage(0.1)[level_95], 0.85);
  EXPECT_GT(mean_coverage(5.0)[level_95], 0.99);
}

TEST(Calibration, WidthAndErrorsAreThoseOfTheirSources) {
  std::mt19937_64 generator(1);
  const Samples samples = samples_of(sigma_C, 0.0, generator);
  const auto central = model(C, S);
  const State initial = central->state_at_temperature(central->reference_density(), 293.0);
  Experiment experiment = measured(C, S, generator);
  const Calibration scatter = calibrate(*central, initial, samples.all, experiment);
  // The noise of the points, from their own quadratic: 21 degrees of freedom.
  EXPECT_NEAR(scatter.measurement_error.front(), noise, 3.0 * noise / std::sqrt(2.0 * 21.0));
  EXPECT_NEAR(scatter.deviation.front(), sigma_C, 3.0 * sigma_C / std::sqrt(120.0));
  EXPECT_NEAR(scatter.median_half_width, 1.96 * sigma_C / (C + S * 1250.0), 0.004);
  EXPECT_NEAR(scatter.pull[3],
              (scatter.model[3] - experiment.ordinate[3]) /
                  std::hypot(scatter.deviation[3], scatter.measurement_error[3]),
              1e-12);
  // Stated errors replace the scatter; that of the abscissa counts by the slope of the model.
  experiment.states_errors = true;
  experiment.ordinate_error.assign(24, 30.0);
  experiment.abscissa_error.assign(24, 20.0);
  const Calibration stated = calibrate(*central, initial, samples.all, experiment);
  EXPECT_NEAR(stated.measurement_error[5], std::hypot(30.0, 20.0 * S), 0.1);
  // A point whose row states no error says nothing: it is not one outside of the band.
  experiment.ordinate_error[5] = std::numeric_limits<double>::quiet_NaN();
  const Calibration gap = calibrate(*central, initial, samples.all, experiment);
  EXPECT_EQ(gap.points, stated.points - 1);
  EXPECT_TRUE(std::isnan(gap.pull[5]));
  EXPECT_EQ(std::lround(gap.coverage.back() * gap.points),
            std::lround(stated.coverage.back() * stated.points) - 1);
  // Rows of which one error is known count with it. Pressures over volume without errors have a band and no verdict.
  experiment.states_errors = false;
  experiment.kind = ExperimentKind::isentrope;
  EXPECT_TRUE(std::isnan(measurement_errors(experiment, {}).front()));
  experiment.kind = ExperimentKind::shock_velocity;
  for (auto* column : {&experiment.abscissa, &experiment.ordinate}) column->resize(3);
  EXPECT_THROW(measurement_errors(experiment, {}), InputError);
}

}  // namespace
}  // namespace whipple::eos::experiments

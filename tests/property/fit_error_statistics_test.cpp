// SPDX-License-Identifier: BSD-3-Clause
// The errors that the fit states are those that it makes, over many realisations of the noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/property/fit_adaptive.hpp"
#include "tests/property/fit_recovery.hpp"

namespace whipple::fit {
namespace {

using testing::fitted;
using testing::Noise;
using testing::noise_only;
using testing::SyntheticStore;
using testing::true_constants;
using testing::values;

// Over many seeds: no bias beyond 3 sigma of the mean, the scatter is the stated error, the correlation of C
// and S is the stated one, and chi^2 is its number of degrees of freedom.
TEST(FitRecovery, StatedErrorsAreTheErrorsMade) {
  constexpr int seeds = 60;
  const eos::GrayConstants truth = true_constants();
  const std::vector<double> expected = values(truth);
  std::vector<double> sum(fitted.size(), 0.0);
  std::vector<double> squares(fitted.size(), 0.0);
  double chi_squared = 0.0;
  double degrees_of_freedom = 0.0;
  double product = 0.0;
  double stated_correlation = 0.0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const SyntheticStore store(truth, Noise{}, seed);
    const GrayFit fit = fit_gray(store.points, noise_only(), "synthetic");
    std::vector<double> pull(fitted.size());
    for (std::size_t i = 0; i < fitted.size(); ++i) {
      const Constant& constant = fit.constant(fitted[i]);
      pull[i] = (constant.value - expected[i]) / constant.error;
      EXPECT_LT(std::abs(pull[i]), 4.5) << fitted[i] << ", seed " << seed;  // 1 in 1000 tests by chance
      EXPECT_NEAR(constant.statistical_error, constant.error, 1e-6 * constant.error);
      sum[i] += pull[i];
      squares[i] += pull[i] * pull[i];
    }
    product += pull[1] * pull[2];
    stated_correlation += fit.correlation()(1, 2);
    chi_squared += fit.chi_squared;
    degrees_of_freedom += fit.degrees_of_freedom;
  }
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const double mean = sum[i] / seeds;
    EXPECT_LT(std::abs(mean), 3.5 / std::sqrt(seeds)) << fitted[i];
    const double scatter = std::sqrt(squares[i] / seeds - mean * mean);
    EXPECT_NEAR(scatter, 1.0, 3.5 / std::sqrt(2.0 * seeds)) << fitted[i];
  }
  EXPECT_NEAR(product / seeds, stated_correlation / seeds, 3.5 * 1.4 / std::sqrt(seeds));
  EXPECT_LT(stated_correlation / seeds, -0.5);  // intercept and slope of a line far from the origin
  EXPECT_NEAR(chi_squared / degrees_of_freedom, 1.0, 3.5 * std::sqrt(2.0 / degrees_of_freedom));
}

// The errors that are stated are made: root mean square over realisations of noise and model errors.
TEST(Adaptive, StatedErrorsAreMade) {
  const double exact = [] {
    const md::Plan plan =
        testing::plan_from(testing::plan_text(testing::outcome_keys("hugoniot_pressure") + "budget = 1e9"));
    return outcome_of(testing::truth(), *plan.adaptive).value;
  }();
  constexpr int realisations = 60;
  double made_even = 0.0;
  double made_chosen = 0.0;
  double stated_even = 0.0;
  double stated_chosen = 0.0;
  for (unsigned seed = 1; seed <= realisations; ++seed) {
    const auto [even, chosen] = testing::even_and_chosen("hugoniot_pressure", 1.0, seed);
    made_even += std::pow(even.standing->value / exact - 1.0, 2) / realisations;
    made_chosen += std::pow(chosen.standing->value / exact - 1.0, 2) / realisations;
    stated_even += even.standing->error / exact / realisations;
    stated_chosen += chosen.standing->error / exact / realisations;
  }
  made_even = std::sqrt(made_even);
  made_chosen = std::sqrt(made_chosen);
  std::printf("even plan %.3f %% stated, %.3f %% made; chosen points %.3f %%, %.3f %%\n", 100 * stated_even,
              100 * made_even, 100 * stated_chosen, 100 * made_chosen);
  EXPECT_LT(made_chosen, made_even);
  // A standard deviation of 60 numbers is known to 9 %: three of these.
  EXPECT_NEAR(made_chosen, stated_chosen, 0.28 * stated_chosen);
  EXPECT_NEAR(made_even, stated_even, 0.28 * stated_even);
}

// The other outcomes beside those of the quick tests.
TEST(Adaptive, ChosenPointsTellMoreThanAnEvenPlanOfTheSameCost) {
  testing::expect_less_error_than_even_plan("hugoniot_pressure");
  testing::expect_less_error_than_even_plan("shock_melting_pressure");
  testing::expect_less_error_than_even_plan("release_melting_pressure");
}

}  // namespace
}  // namespace whipple::fit

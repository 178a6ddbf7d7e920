// SPDX-License-Identifier: BSD-3-Clause
// Points chosen for an outcome: what they would bring is what they bring, and it is more than an even plan of
// the same cost brings (docs/theory/fit.md, section 8).
#include "tests/property/fit_adaptive.hpp"

#include <gtest/gtest.h>

#include <random>

#include "md_fitting/fit/design.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {
namespace {

using testing::plan_from;
using testing::plan_text;
using testing::Points;
using testing::SyntheticDynamics;
using testing::truth;

// The update is that of the inverse normal matrix: against inversion from scratch, with correlated rows.
TEST(Adaptive, UpdateOfTheCovarianceIsThatOfTheLargerProblem) {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  const auto random = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); }));
  };
  const Eigen::MatrixXd jacobian = random(12, 4);
  const Eigen::MatrixXd root = random(12, 12);
  const Eigen::MatrixXd sigma = root * root.transpose() + Eigen::MatrixXd::Identity(12, 12);
  const Eigen::VectorXd gradient = random(4, 1);
  const auto direct = [&](Eigen::Index rows) {
    const Eigen::MatrixXd j = jacobian.topRows(rows);
    const Eigen::MatrixXd weights = inverse(sigma.topLeftCorner(rows, rows));
    const Eigen::MatrixXd covariance = inverse(j.transpose() * weights * j);
    return gradient.dot(covariance * gradient);
  };
  Design design(jacobian, sigma, Eigen::VectorXd::Constant(4, 1e6), {0, 1, 2, 3, 4, 5, 6});
  EXPECT_NEAR(design.variance(gradient), direct(7), 1e-8 * direct(7));
  const std::vector<Eigen::Index> one = {7};
  const std::vector<Eigen::Index> three = {8, 9, 10};
  EXPECT_NEAR(design.reduction(one, gradient), direct(7) - direct(8), 1e-8 * direct(7));
  design.add(one);
  EXPECT_NEAR(design.reduction(three, gradient), direct(8) - direct(11), 1e-8 * direct(7));
  design.add(three);
  EXPECT_NEAR(design.variance(gradient), direct(11), 1e-8 * direct(7));
}

// What a round expects is what the next fit finds, when the answers have no noise: the expected error against
// the error of the larger fit, and the linear error of the present against the fit's own.
TEST(Adaptive, ExpectedErrorsComeTrue) {
  const md::Plan plan = plan_from(
      plan_text(testing::outcome_keys("hugoniot_temperature") + "target_error = 1e-6\nbudget = 4e8"));
  const SyntheticDynamics exact(truth(), 0.0, 1);
  Points points;
  Proposal proposal = propose(plan, points, 4, "synthetic");
  ASSERT_TRUE(proposal.next && !proposal.standing) << "the start needs no fit";
  exact.answer(*proposal.next, points);
  proposal = propose(plan, points, 4, "synthetic");
  ASSERT_TRUE(proposal.standing.has_value());
  EXPECT_NEAR(proposal.standing->value, outcome_of(truth(), *plan.adaptive).value,
              1e-3 * proposal.standing->value);
  for (int round = 0; proposal.next && round < 2; ++round) {
    const double expected = proposal.standing->expected_error;
    EXPECT_LT(expected, proposal.standing->error);
    exact.answer(*proposal.next, points);
    proposal = propose(plan, points, 4, "synthetic");
    EXPECT_NEAR(proposal.standing->error, expected, 0.03 * expected) << "round " << round;
  }
}

// At equal cost the chosen points leave a smaller error than the even plan of all sections.
TEST(Adaptive, ChosenPointsTellMoreThanAnEvenPlanOfTheSameCost) {
  testing::expect_less_error_than_even_plan("hugoniot_temperature");
}

// Every outcome that a plan may name exists for copper.
TEST(Adaptive, EveryOutcomeHasAValue) {
  for (const char* name : md::adaptive_outcomes) {
    md::AdaptivePlan wish;
    wish.outcome = name;
    wish.volume_ratio = 0.8;
    const Outcome outcome = outcome_of(truth(), wish);
    EXPECT_GT(outcome.value, outcome.unit == "K" ? 700.0 : 1e10) << name;
    EXPECT_LT(outcome.value, outcome.unit == "K" ? 3000.0 : 5e11) << name;
  }
}

TEST(Adaptive, ABudgetBelowTheFirstFitIsAnError) {
  const md::Plan plan = plan_from(plan_text("outcome = \"shock_melting_pressure\"\nbudget = 1e6"));
  EXPECT_THROW(propose(plan, {}, 1, "synthetic"), InputError);
}

// A point that failed is neither repeated nor counted as a datum.
TEST(Adaptive, FailedPointsAreLeftOut) {
  const md::Plan plan =
      plan_from(plan_text("outcome = \"hugoniot_pressure\"\nvolume_ratio = 0.75\ntarget_error = 1e-6"));
  const SyntheticDynamics exact(truth(), 0.0, 1);
  Points points;
  exact.answer(*propose(plan, points, 1, "synthetic").next, points);
  const Proposal first = propose(plan, points, 1, "synthetic");
  ASSERT_TRUE(first.next && first.next->hugoniot);
  const std::size_t before = points.size();
  exact.answer(*first.next, points);
  ASSERT_EQ(points.size(), before + 1);
  points.back().status = md::PointStatus::failed;
  const Proposal second = propose(plan, points, 1, "synthetic");
  ASSERT_TRUE(second.next && second.next->hugoniot);
  EXPECT_NE(second.next->hugoniot->volume_ratio, first.next->hugoniot->volume_ratio);
  EXPECT_EQ(second.standing->error, first.standing->error);
}

}  // namespace
}  // namespace whipple::fit

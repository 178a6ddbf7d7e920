// SPDX-License-Identifier: BSD-3-Clause
// The weighted least squares: closed forms, certified values, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>

#include "md_fitting/fit/least_squares.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// NIST Statistical Reference Datasets, Misra1a (Misra, D., NIST 1978): y = b1 (1 - exp(-b2 x)), certified
// parameters and standard deviations.
TEST(LeastSquares, ReproducesTheCertifiedValuesOfMisra1a) {
  const std::vector<double> y = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
  const std::vector<double> x = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                                 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
  const auto n = static_cast<Eigen::Index>(y.size());
  LeastSquaresProblem problem;
  // Parameters of order one: b1 = 100 p1, b2 = 1e-3 p2.
  problem.residuals = [&](const VectorXd& p) {
    VectorXd r(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      r[i] = y[k] - 100.0 * p[0] * (1.0 - std::exp(-1e-3 * p[1] * x[k]));
    }
    return r;
  };
  problem.start = VectorXd(2);
  problem.start << 2.5, 0.5;
  problem.statistical = MatrixXd::Identity(n, n);
  problem.model = MatrixXd::Zero(n, n);
  const LeastSquaresSolution solution = solve(problem);
  EXPECT_NEAR(100.0 * solution.parameters[0], 2.3894212918E+02, 1e-5);
  EXPECT_NEAR(1e-3 * solution.parameters[1], 5.5015643181E-04, 1e-11);
  EXPECT_NEAR(solution.chi_squared, 1.2455138894E-01, 1e-9);
  // NIST scales by the residual standard deviation.
  const double variance = solution.chi_squared / solution.degrees_of_freedom;
  EXPECT_NEAR(100.0 * std::sqrt(variance * solution.covariance(0, 0)), 2.7070075241E+00, 1e-5);
  EXPECT_NEAR(1e-3 * std::sqrt(variance * solution.covariance(1, 1)), 7.2668688436E-06, 1e-11);
}

/// A straight line with correlated errors: statistical and common parts.
struct LineProblem {
  MatrixXd design{6, 2};
  VectorXd y{6};
  LeastSquaresProblem problem;

  LineProblem() {
    y << 1.1, 1.9, 3.2, 3.9, 5.1, 5.8;
    for (Eigen::Index i = 0; i < 6; ++i) design.row(i) << 1.0, static_cast<double>(i);
    problem.residuals = [this](const VectorXd& p) { return VectorXd(y - design * p); };
    problem.start = VectorXd::Zero(2);
    problem.statistical = 0.01 * MatrixXd::Identity(6, 6);
    problem.statistical(0, 1) = problem.statistical(1, 0) = 0.004;
    const VectorXd common = 0.05 * VectorXd::LinSpaced(6, 0.0, 5.0);
    problem.model = common * common.transpose();
  }
};

// Aitken: p = (A^T S^-1 A)^-1 A^T S^-1 y, covariance (A^T S^-1 A)^-1.
TEST(LeastSquares, IsGeneralisedLeastSquaresForLinearProblems) {
  const LineProblem line;
  const MatrixXd weights = inverse(line.problem.statistical + line.problem.model);
  const MatrixXd covariance = inverse(line.design.transpose() * weights * line.design);
  const VectorXd expected = covariance * line.design.transpose() * weights * line.y;
  const LeastSquaresSolution solution = solve(line.problem);
  EXPECT_LT((solution.parameters - expected).norm(), 1e-8);
  EXPECT_LT((solution.covariance - covariance).norm(), 1e-7 * covariance.norm());
  // The share of the noise: the same estimator G, G S_stat G^T.
  const MatrixXd estimator = covariance * line.design.transpose() * weights;
  const MatrixXd noise = estimator * line.problem.statistical * estimator.transpose();
  EXPECT_LT((solution.statistical_covariance - noise).norm(), 1e-7 * noise.norm());
  EXPECT_LT(noise(1, 1), covariance(1, 1));
}

// Without model errors the noise is everything.
TEST(LeastSquares, NoiseShareIsTheWholeCovarianceWithoutModelErrors) {
  LineProblem line;
  line.problem.model.setZero();
  const LeastSquaresSolution solution = solve(line.problem);
  EXPECT_LT((solution.statistical_covariance - solution.covariance).norm(),
            1e-9 * solution.covariance.norm());
}

TEST(LeastSquares, RefusesWhatTheDataDoNotDetermine) {
  LineProblem line;
  line.problem.residuals = [&](const VectorXd& p) {
    return VectorXd(line.y - line.design.col(0) * (p[0] + p[1]));  // only the sum counts
  };
  EXPECT_THROW(solve(line.problem), StateError);
  line.problem.residuals = [&](const VectorXd& p) { return VectorXd(line.y - line.design.col(0) * p[0]); };
  EXPECT_THROW(solve(line.problem), StateError);
}

TEST(LeastSquares, RefusesDataWithoutErrors) {
  LineProblem line;
  line.problem.statistical.setZero();
  EXPECT_THROW(solve(line.problem), StateError);
}

TEST(LeastSquares, PassesOnExceptionsOfTheLaw) {
  LineProblem line;
  line.problem.residuals = [](const VectorXd&) -> VectorXd { throw InputError("law"); };
  EXPECT_THROW(solve(line.problem), InputError);
}

}  // namespace
}  // namespace whipple::fit

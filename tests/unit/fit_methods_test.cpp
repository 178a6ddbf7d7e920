// SPDX-License-Identifier: BSD-3-Clause
// The parts of the fit that stand for themselves: bounds, leave-one-out residuals, the bootstrap over blocks,
// and the Debye temperature from elastic constants.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "md_fitting/fit/bootstrap.hpp"
#include "md_fitting/fit/bounds.hpp"
#include "md_fitting/fit/cross_validation.hpp"
#include "md_fitting/fit/least_squares.hpp"
#include "md_fitting/fit/solid_models.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Every real parameter lies inside the bounds, zero is the start, and the slope is the derivative.
TEST(Bounds, MapTheRealsIntoTheInterval) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Bounds bounds : {Bounds{}, Bounds{.lower = 1.3}, Bounds{-infinity, 4.0}, Bounds{1.05, 2.5}}) {
    const BoundedParameter parameter(2.0, bounds, 0.5);
    EXPECT_NEAR(parameter.value(0.0), 2.0, 1e-14);
    double former = -infinity;
    for (double p = -30.0; p <= 30.0; p += 0.5) {
      const double value = parameter.value(p);
      EXPECT_GE(value, bounds.lower);
      EXPECT_LE(value, bounds.upper);
      EXPECT_GE(value, former);
      former = value;
      const double step = 1e-5;
      const double slope = (parameter.value(p + step) - parameter.value(p - step)) / (2 * step);
      EXPECT_NEAR(parameter.slope(p), slope, 1e-6 * std::abs(slope) + 1e-9);
    }
  }
  EXPECT_THROW(BoundedParameter(1.0, {.lower = 1.0}), StateError);
  EXPECT_THROW(BoundedParameter(3.0, {.lower = 1.0, .upper = 2.0}), StateError);
}

// A minimum near a bound is found as it would be without, with the covariance of the constant itself.
TEST(Bounds, LeaveAMinimumInsideAlone) {
  const BoundedParameter slope(1.0, {.lower = 0.0, .upper = 2.0});
  LeastSquaresProblem problem;
  problem.residuals = [&](const VectorXd& p) {
    VectorXd r(3);
    for (Index i = 0; i < 3; ++i)
      r[i] = 1.9 * static_cast<double>(i + 1) - slope.value(p[0]) * static_cast<double>(i + 1);
    return r;
  };
  problem.start = VectorXd::Zero(1);
  problem.statistical = 0.01 * MatrixXd::Identity(3, 3);
  problem.model = MatrixXd::Zero(3, 3);
  const LeastSquaresSolution solution = solve(problem);
  EXPECT_NEAR(slope.value(solution.parameters[0]), 1.9, 1e-6);
  // The covariance of the constant is that of the linear problem: 0.01/(1 + 4 + 9).
  EXPECT_NEAR(std::pow(slope.slope(solution.parameters[0]), 2) * solution.covariance(0, 0), 0.01 / 14.0,
              1e-7);
}

/// A linear problem with correlated errors.
struct Linear {
  MatrixXd X;
  VectorXd y;
  MatrixXd sigma;

  [[nodiscard]] LeastSquaresProblem problem() const {
    LeastSquaresProblem p;
    p.residuals = [this](const VectorXd& b) { return VectorXd(y - X * b); };
    p.start = VectorXd::Zero(X.cols());
    p.statistical = sigma;
    p.model = MatrixXd::Zero(sigma.rows(), sigma.cols());
    return p;
  }
};

Linear linear_problem() {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  constexpr Index n = 12;
  Linear linear;
  linear.X.resize(n, 3);
  linear.y.resize(n);
  for (Index i = 0; i < n; ++i) {
    const double t = 0.3 * static_cast<double>(i);
    linear.X.row(i) << 1.0, t, t * t;
    linear.y[i] = 2.0 - t + 0.5 * t * t + 0.2 * normal(generator);
  }
  MatrixXd a(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k < n; ++k) a(i, k) = 0.05 * normal(generator) + (i == k ? 0.2 : 0.0);
  }
  linear.sigma = a * a.transpose();
  return linear;
}

// Against the definition: the fit without the datum, and the best prediction of it from the others'
// residuals.
TEST(LeaveOneOut, IsTheFitWithoutTheDatum) {
  const Linear all = linear_problem();
  const Index n = all.X.rows();
  const LeastSquaresSolution solution = solve(all.problem());
  for (const Index rows : {1, 2}) {
    std::vector<Datum> data;
    for (Index i = 0; i < n; i += rows) data.push_back({"quantity " + std::to_string(i), "datum", i, rows});
    const std::vector<LeaveOneOut> parts = leave_one_out(data, solution, 3);
    ASSERT_EQ(parts.size(), data.size());
    for (std::size_t d = 0; d < data.size(); ++d) {
      std::vector<Index> out;
      std::vector<Index> kept;
      for (Index i = 0; i < n; ++i)
        (i >= data[d].begin && i < data[d].begin + rows ? out : kept).push_back(i);
      const MatrixXd X = all.X(kept, Eigen::all);
      const VectorXd y = all.y(kept);
      const MatrixXd S = all.sigma(kept, kept);
      const MatrixXd weights = whipple::inverse(S);
      const MatrixXd covariance = whipple::inverse(X.transpose() * weights * X);
      const VectorXd b = covariance * X.transpose() * weights * y;
      // Best linear unbiased prediction of correlated data, and the covariance of its error.
      const MatrixXd cross = all.sigma(out, kept);
      const MatrixXd Xo = all.X(out, Eigen::all);
      const VectorXd prediction = Xo * b + cross * weights * (y - X * b);
      const MatrixXd gap = Xo - cross * weights * X;
      const MatrixXd error = MatrixXd(all.sigma(out, out)) - cross * weights * cross.transpose() +
                             gap * covariance * gap.transpose();
      const VectorXd difference = VectorXd(all.y(out)) - prediction;
      const double pull =
          std::sqrt(difference.dot(VectorXd(solve_symmetric(error, difference))) / static_cast<double>(rows));
      EXPECT_NEAR(parts[d].rms, pull, 1e-5 * pull);
      double shift = 0.0;
      for (Index k = 0; k < 3; ++k) {
        shift =
            std::max(shift, std::abs(b[k] - solution.parameters[k]) / std::sqrt(solution.covariance(k, k)));
      }
      EXPECT_NEAR(parts[d].shift, shift, 1e-5 * shift);
    }
  }
}

// A datum that alone bears a constant cannot be predicted: it is not counted.
TEST(LeaveOneOut, PassesOverWhatTheRestDoesNotKnow) {
  Linear linear = linear_problem();
  linear.X.conservativeResize(Eigen::NoChange, 4);
  linear.X.col(3).setZero();
  linear.X(0, 3) = 1.0;  // a constant of the first datum alone
  const LeastSquaresSolution solution = solve(linear.problem());
  const std::vector<Datum> data = {{"alone", "first", 0, 1}, {"others", "second", 1, 1}};
  const std::vector<LeaveOneOut> parts = leave_one_out(data, solution, 4);
  EXPECT_EQ(parts[0].data, 0);
  EXPECT_EQ(parts[1].data, 1);
}

md::PointRecord state_with_blocks(std::mt19937_64& generator, bool with_blocks) {
  std::normal_distribution<double> normal;
  md::PointRecord point;
  point.protocol = "isochore";
  point.status = md::PointStatus::done;
  constexpr int blocks = 16;
  std::vector<double> pressure, energy;
  for (int b = 0; b < blocks; ++b) {
    const double first = normal(generator);
    pressure.push_back(1e9 + 1e7 * first);
    energy.push_back(1e6 + 1e3 * (0.8 * first + 0.6 * normal(generator)));
  }
  const auto estimate = [](const std::vector<double>& means) {
    const double mean = std::accumulate(means.begin(), means.end(), 0.0) / blocks;
    double squares = 0.0;
    for (const double value : means) squares += (value - mean) * (value - mean);
    return md::Estimate{mean, std::sqrt(squares / (blocks * (blocks - 1)))};
  };
  point.results = {{"pressure", estimate(pressure)},
                   {"specific_internal_energy", estimate(energy)},
                   {"error_correlation", {0.8, 0.0}}};
  if (with_blocks) point.blocks = {{"pressure", pressure}, {"specific_internal_energy", energy}};
  return point;
}

// The scatter over replicates is the stated error, P and E together; without blocks the stated error is drawn
// from.
TEST(Bootstrap, ScattersByTheStatedErrors) {
  std::mt19937_64 generator(3);
  for (const bool with_blocks : {true, false}) {
    const std::vector<md::PointRecord> points = {state_with_blocks(generator, with_blocks)};
    const auto values = [](std::span<const md::PointRecord> drawn) {
      return VectorXd(Eigen::Vector2d(drawn[0].result("pressure").value,
                                      drawn[0].result("specific_internal_energy").value));
    };
    constexpr int replicates = 4000;
    const BootstrapResult result = bootstrap(points, replicates, 1, values);
    EXPECT_EQ(result.points_with_blocks, with_blocks ? 1 : 0);
    EXPECT_EQ(result.points_without, with_blocks ? 0 : 1);
    for (const auto& [row, name] : {std::pair(0, "pressure"), std::pair(1, "specific_internal_energy")}) {
      const md::Estimate stated = points[0].result(name);
      const double scatter = std::sqrt(result.covariance(row, row));
      EXPECT_NEAR(scatter / stated.error, 1.0, 4.0 / std::sqrt(2.0 * replicates));
      EXPECT_NEAR(result.mean[row], stated.value, 4.0 * stated.error / std::sqrt(replicates));
    }
    const double correlation =
        result.covariance(0, 1) / std::sqrt(result.covariance(0, 0) * result.covariance(1, 1));
    EXPECT_NEAR(correlation, 0.8, with_blocks ? 0.2 : 0.03);  // 16 blocks know it to 0.1
    // The same seed gives the same replicates.
    EXPECT_EQ(bootstrap(points, 10, 5, values).mean, bootstrap(points, 10, 5, values).mean);
  }
}

// A shock state keeps the jump conditions.
TEST(Bootstrap, KeepsTheJumpConditions) {
  md::PointRecord point;
  point.protocol = "hugoniot";
  point.status = md::PointStatus::done;
  const double v0 = 1.12e-4, v = 0.9e-4, pressure = 3e10;
  point.conditions = {{"specific_volume", v}};
  point.results = {{"pressure", {pressure, 1e9}},
                   {"shock_velocity", {v0 * std::sqrt(pressure / (v0 - v)), 0.0}},
                   {"particle_velocity", {std::sqrt(pressure * (v0 - v)), 0.0}}};
  std::mt19937_64 generator(1);
  const std::vector<md::PointRecord> points = {point};
  for (int i = 0; i < 10; ++i) {
    const md::PointRecord drawn = resampled(points, generator).front();
    const double us = drawn.result("shock_velocity").value, up = drawn.result("particle_velocity").value;
    EXPECT_NE(drawn.result("pressure").value, pressure);
    EXPECT_NEAR(us * up / v0, drawn.result("pressure").value, 1e-9 * pressure);
    EXPECT_NEAR(v0 * (us - up) / us, v, 1e-12 * v);
  }
}

TEST(Bootstrap, NeedsReplicatesThatCanBeFitted) {
  const std::vector<md::PointRecord> none;
  const auto fails = [](std::span<const md::PointRecord>) -> VectorXd { throw StateError("no"); };
  EXPECT_THROW(bootstrap(none, 1, 1, fails), InputError);
  EXPECT_THROW(bootstrap(none, 10, 1, fails), StateError);
}

// Copper's measured moduli and density (Hill averages of C11, C12, C44 = 176.2, 124.9, 81.8 GPa at 4 K:
// Overton, Gaffney, Phys. Rev. 98 (1955) 969) give the calorimetric Debye temperature, 343 to 345 K.
TEST(DebyeTemperature, OfCopperFromItsElasticConstants) {
  const double c11 = 176.2e9, c12 = 124.9e9, c44 = 81.8e9;
  const double bulk = (c11 + 2 * c12) / 3;
  const double voigt = (c11 - c12 + 3 * c44) / 5;
  const double reuss = 5 * (c11 - c12) * c44 / (4 * c44 + 3 * (c11 - c12));
  EXPECT_NEAR(debye_temperature(bulk, 0.5 * (voigt + reuss), 1.0 / 9018.0, 63.546e-3), 344.0, 10.0);
}

}  // namespace
}  // namespace whipple::fit

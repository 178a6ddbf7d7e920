// SPDX-License-Identifier: BSD-3-Clause
// Curves that are left out and predicted: beside a solution without them, and the coverage of draws.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "md_fitting/fit/correction/left_out_curves.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Three curves of four states each: smooth functions of one abscissa, with errors.
struct Curves {
  MatrixXd signal{12, 12}, errors = MatrixXd::Zero(12, 12);
  std::vector<LeftOutDatum> data;

  Curves() {
    for (Index i = 0; i < 12; ++i) {
      for (Index j = 0; j < 12; ++j) {
        const double apart = 0.4 * static_cast<double>(i - j);
        signal(i, j) = std::exp(-0.5 * apart * apart);
      }
      errors(i, i) = 0.01 * static_cast<double>(1 + i % 3);
      data.push_back(
          {.kind = i % 2 == 0 ? "pressure" : "energy", .curve = std::to_string(i / 4), .scale = 2.0});
    }
  }
  [[nodiscard]] VectorXd draw(std::mt19937_64& random) const {
    std::normal_distribution<double> normal;
    VectorXd x(12);
    for (Index i = 0; i < 12; ++i) x[i] = normal(random);
    return MatrixXd((signal + errors).llt().matrixL()) * x;
  }
};

TEST(LeftOutCurves, EqualASolutionWithoutThem) {
  const Curves curves;
  std::mt19937_64 random(1);
  const VectorXd r = curves.draw(random);
  const std::vector<LeftOutCurves> found =
      left_out_curves(curves.data, r, curves.signal + curves.errors, curves.errors);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].kind, "pressure");
  EXPECT_EQ(found[0].data, 6);
  EXPECT_EQ(found[0].curves, 3);
  double squares = 0.0;
  int inside = 0;
  for (Index curve = 0; curve < 3; ++curve) {
    std::vector<Index> others;
    for (Index i = 0; i < 12; ++i) {
      if (i / 4 != curve) others.push_back(i);
    }
    const MatrixXd of_others = curves.signal(others, others) + curves.errors(others, others);
    for (Index i = 4 * curve; i < 4 * curve + 4; i += 2) {
      const VectorXd weights = of_others.ldlt().solve(VectorXd(curves.signal(others, i)));
      const double deviation = r[i] - weights.dot(VectorXd(r(others)));
      const double variance =
          curves.signal(i, i) - weights.dot(VectorXd(curves.signal(others, i))) + curves.errors(i, i);
      squares += std::pow(deviation / 2.0, 2);
      inside += std::abs(deviation) <= 1.95996 * std::sqrt(variance) ? 1 : 0;
    }
  }
  EXPECT_NEAR(found[0].rms, std::sqrt(squares / 6.0), 1e-12);
  EXPECT_NEAR(found[0].inside_95, inside / 6.0, 1e-12);
}

TEST(LeftOutCurves, CoverWhatTheyStateForDrawsOfTheirOwn) {
  const Curves curves;
  std::mt19937_64 random(2);
  double inside_68 = 0.0, inside_95 = 0.0;
  constexpr int draws = 2000;
  for (int k = 0; k < draws; ++k) {
    for (const LeftOutCurves& kind :
         left_out_curves(curves.data, curves.draw(random), curves.signal + curves.errors, curves.errors)) {
      inside_68 += 0.5 * kind.inside_68 / draws;
      inside_95 += 0.5 * kind.inside_95 / draws;
    }
  }
  EXPECT_NEAR(inside_68, 0.68, 0.01);
  EXPECT_NEAR(inside_95, 0.95, 0.005);
}

/// Draws of curves that deviate by more than their stated covariance says.
TEST(LeftOutCurves, AreWidenedToWhatTheOthersDeviate) {
  constexpr Index curves = 12, states = 2, count = curves * states;
  constexpr double too_small = 9.0;
  MatrixXd signal(count, count), errors = MatrixXd::Zero(count, count);
  std::vector<LeftOutDatum> data;
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < count; ++j) {
      const Index curves_apart = i / states - j / states;
      const double apart = 0.7 * static_cast<double>(curves_apart);
      const double same = i % states == j % states ? 1.0 : 0.5;
      signal(i, j) = same * std::exp(-0.5 * std::abs(apart));
    }
    errors(i, i) = 0.001;
    data.push_back(
        {.kind = "fluid, pressure", .curve = fmt::format("{:02}", i / states), .group = CurveGroup::fluid});
  }
  const MatrixXd root = MatrixXd(signal + errors).llt().matrixL();
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  double widened = 0.0, inside = 0.0, inside_as_stated = 0.0;
  constexpr int draws = 400;
  for (int k = 0; k < draws; ++k) {
    VectorXd x(count);
    for (Index i = 0; i < count; ++i) x[i] = normal(random);
    const MatrixXd stated = signal / too_small + errors;
    const LeftOutCurves found = left_out_curves(data, root * x, stated, errors).front();
    widened += found.widened / draws;
    inside += found.inside_95 / draws;
    for (LeftOutDatum& datum : data) datum.group = CurveGroup::none;
    const LeftOutCurves alone = left_out_curves(data, root * x, stated, errors).front();
    EXPECT_EQ(alone.widened, 1.0);
    inside_as_stated += alone.inside_95 / draws;
    for (LeftOutDatum& datum : data) datum.group = CurveGroup::fluid;
  }
  EXPECT_NEAR(widened, 3.0, 0.15);
  EXPECT_NEAR(inside, 0.93, 0.02);  // the factor of 22 deviations scatters
  EXPECT_LT(inside_as_stated, 0.55);
}

}  // namespace
}  // namespace whipple::fit

// SPDX-License-Identifier: BSD-3-Clause
// Searches, samples and indices of studies, without runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "src/core/base/error.hpp"
#include "src/sweep/bisection.hpp"
#include "src/sweep/sampling.hpp"
#include "src/sweep/study.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::sweep {
namespace {

using testing::HasSubstr;

/// Searches between 0 and 1 as a study does.
std::vector<Judged> searched(const std::function<Verdict(double)>& verdict, double tolerance, int scan = 2) {
  std::vector<Judged> judged;
  for (int i = 0; i < scan; ++i) {
    const double at = static_cast<double>(i) / (scan - 1);
    judged.push_back({at, verdict(at)});
  }
  for (;;) {
    const std::vector<double> next = next_values(judged, tolerance);
    if (next.empty()) return judged;
    for (const double at : next) judged.push_back({at, verdict(at)});
    std::ranges::sort(judged, {}, &Judged::at);
  }
}

Verdict beyond(double x, double limit) { return x < limit ? Verdict::below : Verdict::above; }

TEST(Bisection, IntervalHoldsLimitAtEveryTolerance) {
  for (const double limit : {0.1234567, 0.5, 0.99}) {
    for (const double tolerance : {0.3, 1e-2, 1e-5, 1e-12}) {
      const auto judged = searched([&](double x) { return beyond(x, limit); }, tolerance);
      const Limit found = limit_of(judged);
      ASSERT_EQ(found.kind, Limit::Kind::found);
      EXPECT_TRUE(found.rises);
      EXPECT_LE(found.lower, limit);
      EXPECT_GE(found.upper, limit);
      EXPECT_LE(found.upper - found.lower, tolerance);
      EXPECT_LE(static_cast<double>(judged.size()), 3.0 + std::log2(1.0 / tolerance));  // it halves
    }
  }
}

TEST(Bisection, EndsAtNeighbouringNumbers) {
  const Limit found = limit_of(searched([](double x) { return beyond(x, 0.3); }, 0.0));
  EXPECT_EQ(std::nextafter(found.lower, 1.0), found.upper);
}

TEST(Bisection, UndecidedValuesLieInside) {
  const Limit found = limit_of(searched(
      [](double x) { return x < 0.4   ? Verdict::above
                            : x > 0.6 ? Verdict::below
                                      : Verdict::undecided; },
      0.01));
  ASSERT_EQ(found.kind, Limit::Kind::found);
  EXPECT_FALSE(found.rises);
  EXPECT_NEAR(found.lower, 0.4, 0.01);
  EXPECT_LT(found.lower, 0.4);
  EXPECT_NEAR(found.upper, 0.6, 0.01);
  EXPECT_GT(found.upper, 0.6);
}

TEST(Bisection, SaysThatVerdictIsNotMonotone) {
  const auto verdict = [](double x) { return x > 0.3 && x < 0.6 ? Verdict::below : beyond(x, 0.1); };
  const Limit found = limit_of(searched(verdict, 1e-3, 11));
  ASSERT_EQ(found.kind, Limit::Kind::not_monotone);
  ASSERT_EQ(found.changes.size(), 3U);
  for (const auto& [change, at] :
       {std::pair(found.changes[0], 0.1), {found.changes[1], 0.3}, {found.changes[2], 0.6}}) {
    EXPECT_LE(change.first, at);
    EXPECT_GE(change.second, at);
    EXPECT_LE(change.second - change.first, 1e-3);
  }
}

TEST(Bisection, NoLimitWithoutChangeOrDecidedEnds) {
  EXPECT_EQ(limit_of(searched([](double) { return Verdict::above; }, 0.1)).kind, Limit::Kind::none);
  const auto open_end = [](double x) { return x > 0.9 ? Verdict::undecided : beyond(x, 0.5); };
  EXPECT_EQ(limit_of(searched(open_end, 0.01)).kind, Limit::Kind::none);
}

TEST(Bisection, IntervalHoldsThoseOfAllVariants) {
  const auto limit = [](double at) {
    return limit_of(searched([=](double x) { return beyond(x, at); }, 0.01));
  };
  const std::vector<Limit> limits = {limit(0.52), limit(0.31), limit(0.44)};
  const auto all = hull(limits);
  ASSERT_TRUE(all);
  for (const Limit& one : limits) {
    EXPECT_LE(all->first, one.lower);
    EXPECT_GE(all->second, one.upper);
  }
  EXPECT_LE(all->second - all->first, 0.52 - 0.31 + 0.02);
  EXPECT_FALSE(hull(std::vector{limit(0.5), Limit{}}));
}

TEST(Sampling, HypercubeHasOneSampleInEachStratum) {
  constexpr std::size_t count = 37, dimensions = 4;
  const auto points = latin_hypercube(count, dimensions, 5);
  EXPECT_EQ(points, latin_hypercube(count, dimensions, 5));
  EXPECT_NE(points, latin_hypercube(count, dimensions, 6));
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::vector<int> hits(count);
    for (const auto& point : points) ++hits.at(static_cast<std::size_t>(std::ceil(point[d] * count)) - 1);
    EXPECT_EQ(std::ranges::count(hits, 1), count);
  }
  // The strata of two dimensions are not ordered alike.
  double correlation = 0.0;
  for (const auto& point : points) correlation += (point[0] - 0.5) * (point[1] - 0.5) * 12.0 / count;
  EXPECT_LT(std::abs(correlation), 0.5);
}

// Ishigami and Homma, ISUMA (1990): y = sin a + 7 sin^2 b + 0.1 c^4 sin a, inputs uniform in (-pi, pi). The indices are
// 0.3139, 0.4424 and 0.
TEST(Sampling, FirstOrderIndicesOfIshigamisFunction) {
  constexpr double pi = std::numbers::pi;
  const auto ishigami = [](const std::vector<double>& x) {
    const double a = std::sin(x[0]), b = std::sin(x[1]);
    return a + 7.0 * b * b + 0.1 * std::pow(x[2], 4) * a;
  };
  for (const auto& draw : {latin_hypercube, random_samples}) {
    constexpr std::size_t count = 20000;
    auto points = draw(count, 3, 11);
    std::array<std::vector<double>, 3> x;
    std::vector<double> y;
    for (auto& point : points) {
      for (double& value : point) value = pi * (2.0 * value - 1.0);
      for (std::size_t d = 0; d < 3; ++d) x[d].push_back(point[d]);
      y.push_back(ishigami(point));
    }
    const double three_sigma = 3.0 / std::sqrt(static_cast<double>(count));
    EXPECT_NEAR(first_order_index(x[0], y, Design::sampled), 0.3139, three_sigma);
    EXPECT_NEAR(first_order_index(x[1], y, Design::sampled), 0.4424, three_sigma);
    EXPECT_NEAR(first_order_index(x[2], y, Design::sampled), 0.0, three_sigma);
  }
}

TEST(Sampling, IndicesOfListsAreThoseOfGroupMeans) {
  std::vector<double> a, b, y;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 5; ++k) {
      a.push_back(i);
      b.push_back(k);
      y.push_back(3.0 * i + k);
    }
  }
  const double of_a = 9.0 * 1.25, of_b = 2.0;  // variances of 0..3 times 3, and of 0..4
  EXPECT_NEAR(first_order_index(a, y, Design::listed), of_a / (of_a + of_b), 1e-12);
  EXPECT_NEAR(first_order_index(b, y, Design::listed), of_b / (of_a + of_b), 1e-12);
  EXPECT_TRUE(std::isnan(first_order_index(a, std::vector<double>(y.size(), 4.0), Design::listed)));
}

// Every sample occurs once per value of the list: neighbours in the order of a sampled variable are then one sample.
TEST(Sampling, ASampledVariableWithoutInfluenceHasNoneBesideAList) {
  std::vector<double> list, sampled, y;
  for (int sample = 0; sample < 8; ++sample) {
    for (const double speed : {1.0, 2.0}) {
      list.push_back(speed);
      sampled.push_back(0.1 * sample);
      y.push_back(3.0 * speed);
    }
  }
  EXPECT_NEAR(first_order_index(list, y, Design::listed), 1.0, 1e-12);
  EXPECT_NEAR(first_order_index(sampled, y, Design::sampled), 0.0, 1e-12);
}

TEST(Studies, RefuseWhatWouldOverwriteOrSpoilItself) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "study.toml";
  const auto fault = [&](const std::string& text) -> std::string {
    std::ofstream(file) << "case = \"case.toml\"\n" << text;
    try {
      (void)read_study(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string speed = "[[vary]]\nkey = \"body.0.velocity.2\"\nvalues = [\"1 km/s\"]\n";
  EXPECT_EQ(fault(speed), "accepted");
  EXPECT_THAT(fault(speed + "[[quantity]]\nname = \"a.b\"\n[[quantity]]\nname = \"a.b\"\n"),
              HasSubstr("wanted twice"));
  EXPECT_THAT(fault("[[vary]]\nkey = \"body.0.material\"\nvalues = [\"copper\"]\n[[vary]]\nkey = "
                    "\"body.0.material.eos.gruneisen\"\nvalues = [\"2\"]\n"),
              HasSubstr("which varies as a whole"));
  EXPECT_THAT(fault(speed + "also = [\"body.0\"]\n"), HasSubstr("'body.0.velocity.2' lies in 'body.0'"));
  EXPECT_THAT(fault(speed + speed), HasSubstr("6:7: error: 'body.0.velocity.2' varies twice"));
  EXPECT_THAT(fault("[[vary]]\nkey = \"domain.upper.0\"\nvalues = [\"8 mm\"]\n[bands]\noffsets = [0.5]\n"),
              HasSubstr("'offsets' move the domain"));
  EXPECT_THAT(fault(speed + "[bands]\ncell_sizes = [\"0.5 kg\"]\n"), HasSubstr("0.5 kg"));
  EXPECT_THAT(fault(speed + "[run]\nanalyse = [\"-o\", \"elsewhere\"]\n"),
              HasSubstr("no option that measures"));
}

}  // namespace
}  // namespace whipple::sweep

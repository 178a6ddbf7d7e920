// SPDX-License-Identifier: BSD-3-Clause
// What belongs to a fragment: failed particles beside intact ones, in made-up sets and against the definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

#include "src/analysis/fragments.hpp"
#include "src/analysis/pieces.hpp"
#include "src/core/parallel/threads.hpp"
#include "tests/unit/analysis_support.hpp"

namespace whipple::analysis {
namespace {

constexpr double cell = 1e-3, half = 0.5e-3;
const std::vector<BodyInput> one_body(1);

TEST(Fragments, TwoSpheresOfAWholeModel) {
  Maker maker(0.5e-3);
  const auto sphere = [](const Vector3& centre, double radius) {
    return [=](const Vector3& p) { return (p - centre).norm() < radius; };
  };
  const Vector3 a(0, 0, 0), b(9e-3, 0, 0), fast(100, 0, 3000), slow(-100, 50, 2000);
  const Vector3 box = Vector3::Constant(20e-3);
  maker.fill(-box, box, sphere(a, 4e-3), fast, 0);
  const std::size_t in_first = maker.snapshot.size();
  maker.fill(-box, box, sphere(b, 3e-3), slow, 1);
  maker.add(Vector3(0, 0, 15e-3), fast, 0, 3.0);  // vapour is no fragment
  Frame frame;
  frame.impact_speed = 6000.0;
  const std::vector<BodyInput> bodies(2);
  EXPECT_EQ(find_fragments(maker.snapshot, bodies, frame, 3e-3).list.size(),
            2U);  // bodies never are one piece
  const std::vector<Fragment> found = find_fragments(maker.snapshot, bodies, frame, 1e-3).list;
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].particles, in_first);
  EXPECT_EQ(found[1].particles, maker.snapshot.size() - 1 - in_first);
  const double particle = density * std::pow(0.5e-3, 3);
  EXPECT_NEAR(found[0].mass, static_cast<double>(in_first) * particle, 1e-12 * found[0].mass);
  EXPECT_LT((found[0].velocity - fast).norm(), 1e-9);
  EXPECT_LT((found[1].velocity - slow).norm(), 1e-9);
  EXPECT_LT(found[0].position.norm(), 1e-12);
  EXPECT_LT((found[1].position - b).norm(), 1e-12);
  EXPECT_NEAR(found[0].temperature, 300.0, 1e-9);
  EXPECT_EQ(found[1].body, 1);
  EXPECT_TRUE(found[0].debris);
  EXPECT_NEAR(found[0].volume, found[0].mass / density, 1e-12 * found[0].volume);
}

TEST(Fragments, OneOnTheMirrorPlanesIsWholeOneApartHasCopies) {
  Maker maker(0.5e-3);
  const auto everything = [](const Vector3&) { return true; };
  const Vector3 velocity(10, 20, 1000);
  maker.fill(Vector3::Zero(), Vector3::Constant(2e-3), everything, velocity);          // on both planes
  maker.fill({5e-3, 0, 0}, {7e-3, 2e-3, 2e-3}, everything, velocity);                  // on y = 0
  maker.fill(Vector3::Constant(5e-3), Vector3::Constant(6e-3), everything, velocity);  // on none
  const std::vector<Fragment> found = find_fragments(maker.snapshot, one_body, quarter(), 1e-3).list;
  ASSERT_EQ(found.size(), 3U);
  const double particle = density * std::pow(0.5e-3, 3);
  EXPECT_NEAR(found[0].mass, 4 * 64 * particle, 1e-15);
  EXPECT_EQ(found[0].copies, 1.0);
  EXPECT_LT((found[0].velocity - Vector3(0, 0, 1000)).norm(), 1e-9);
  EXPECT_NEAR(found[1].mass, 2 * 64 * particle, 1e-15);
  EXPECT_EQ(found[1].copies, 2.0);
  EXPECT_LT((found[1].velocity - Vector3(10, 0, 1000)).norm(), 1e-9);
  EXPECT_NEAR(found[2].mass, 8 * particle, 1e-15);
  EXPECT_EQ(found[2].copies, 4.0);
}

TEST(Fragments, ComponentsOfRandomPointsAgreeWithTheDefinitionOnAnyThreads) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(0.0, 1.0);
  std::vector<Vector3> points(3000);
  for (Vector3& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  constexpr double distance = 0.055;
  // Every label by sweeps over all pairs until nothing changes.
  std::vector<std::uint32_t> expected(points.size());
  std::iota(expected.begin(), expected.end(), 0U);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if ((points[i] - points[j]).norm() >= distance || expected[i] == expected[j]) continue;
        expected[i] = expected[j] = std::min(expected[i], expected[j]);
        changed = true;
      }
    }
  }
  const std::size_t components = std::set(expected.begin(), expected.end()).size();
  EXPECT_GT(components, 50U);
  EXPECT_LT(components, 2900U);
  const int threads = parallel::threads();
  for (const int n : {1, 2, 4}) {
    parallel::set_threads(n);
    EXPECT_EQ(connected_components(points, distance), expected) << n << " threads";
  }
  parallel::set_threads(threads);
}

TEST(Fragments, ExponentOfAPowerLaw) {
  // Quantiles of N(m) = (m / m0)^-b: m_i = m0 ((i + 1/2) / n)^(-1/b).
  constexpr double b = 1.06, least = 2e-6;
  std::vector<std::pair<double, double>> masses;
  for (int i = 0; i < 4000; ++i) masses.emplace_back(least * std::pow((i + 0.5) / 4000, -1.0 / b), 2.0);
  masses.emplace_back(0.5 * least, 1.0);  // below the range
  const Exponent found = distribution_exponent(masses, least);
  EXPECT_NEAR(found.value, b, 1e-3);
  EXPECT_EQ(found.count, 8000.0);
  EXPECT_NEAR(found.error, b / std::sqrt(4000.0), 1e-4) << "mirror images tell nothing more";
}

using Masses = std::vector<std::pair<double, double>>;

TEST(Fragments, WeibullDistributionOfItsOwnQuantiles) {
  constexpr double scale = 3e-6;
  for (const double b : {0.8, 1.1, 2.0}) {
    Masses masses;
    for (int i = 0; i < 4000; ++i)
      masses.emplace_back(scale * std::pow(-std::log((i + 0.5) / 4000), 1.0 / b), 1.0);
    const Weibull found = weibull_distribution(masses);
    EXPECT_NEAR(found.exponent, b, 0.01 * b);
    EXPECT_NEAR(found.scale, scale, 0.01 * scale);
  }
  EXPECT_TRUE(std::isnan(weibull_distribution(Masses{{1.0, 1.0}, {2.0, 1.0}}).exponent));
  EXPECT_TRUE(
      std::isnan(weibull_distribution(Masses{{2.0, 1.0}, {2.0, 1.0}, {2.0, 1.0}}).exponent));  // of one mass
}

TEST(Fragments, ImagesAreNoFurtherObservationsOfAWeibullDistribution) {
  const Weibull found = weibull_distribution(Masses{{1.0, 1.0}, {2.0, 1.0}, {4.0, 1.0}, {7.0, 1.0}});
  EXPECT_NEAR(found.error, found.exponent * std::sqrt(6.0 / 4.0) / std::numbers::pi, 1e-12);
  const Weibull images = weibull_distribution(Masses{{1.0, 4.0}, {2.0, 4.0}, {4.0, 4.0}, {7.0, 4.0}});
  EXPECT_NEAR(images.exponent, found.exponent, 1e-12);
  EXPECT_NEAR(images.error, found.error, 1e-12);
  // A fragment that counts twice pulls the exponent as two of them do, with less certainty.
  const Weibull twice = weibull_distribution(Masses{{1.0, 1.0}, {2.0, 1.0}, {4.0, 1.0}, {7.0, 2.0}});
  const Weibull same =
      weibull_distribution(Masses{{1.0, 1.0}, {2.0, 1.0}, {4.0, 1.0}, {7.0, 1.0}, {7.0, 1.0}});
  EXPECT_NEAR(twice.exponent, same.exponent, 1e-9);
  EXPECT_GT(twice.error, same.error);
}

TEST(Fragments, ErrorOfAWeibullExponentIsTheScatterOfSamples) {
  std::mt19937 generator(1);
  std::weibull_distribution<double> law(1.5, 1.0);
  constexpr int samples = 300;
  double sum = 0.0, squares = 0.0, errors = 0.0;
  for (int sample = 0; sample < samples; ++sample) {
    Masses masses;
    for (int i = 0; i < 60; ++i) masses.emplace_back(law(generator), 2.0);
    const Weibull found = weibull_distribution(masses);
    sum += found.exponent, squares += found.exponent * found.exponent, errors += found.error;
  }
  const double mean = sum / samples, scatter = std::sqrt(squares / samples - mean * mean);
  EXPECT_NEAR(scatter / (errors / samples), 1.0, 0.15);
}

/// Particles of a section, two in a cell.
struct Section {
  Maker maker{half};
  Frame frame;

  Section() { frame.dimension = grid::Dimension::plane_strain; }
  void add(double x, double y, bool failed = false) {
    maker.add(Vector3(x, y, 0.0), Vector3(x, 0.0, 0.0));
    maker.snapshot.scalars["failed"].back() = failed ? 2.0 : 0.0;
  }
  void square(double x, double y, int n, bool failed = false) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) add(x + half * i, y + half * j, failed);
    }
  }
  [[nodiscard]] Fragments found(double link = 1.5 * cell) const {
    return find_fragments(maker.snapshot, one_body, frame, link);
  }
};

TEST(Pieces, TwoSquaresPartedByAStringOfFailedParticlesAreTwo) {
  Section section;
  section.square(0.0, 0.0, 10);
  section.square(4.5e-3 + 2.0 * cell, 0.0, 10);
  for (int j = 0; j < 10; ++j) section.add(4.5e-3 + 0.9 * cell, half * j, true);
  const Fragments two = section.found();
  ASSERT_EQ(two.list.size(), 2U);
  EXPECT_EQ(two.list[0].particles, 110U);  // the string belongs to the nearer face
  EXPECT_EQ(two.list[0].intact, 100U);
  EXPECT_EQ(two.list[1].particles, 100U);
  EXPECT_EQ(two.of_body[0].loose, 0.0);
  EXPECT_EQ(two.of_body[0].pieces, 2.0);
  // By distance alone the string connects them.
  const Table by_distance = pieces_by_distance(section.maker.snapshot, one_body, section.frame, cell);
  EXPECT_EQ(by_distance["pieces"], (std::vector<double>{1.0, 1.0, 1.0}));
  EXPECT_EQ(by_distance["link"], (std::vector<double>{1.25, 1.5, 2.0}));

  section.square(40.0 * cell, -30.0 * cell, 5, true);
  section.square(-40.0 * cell, 3.0 * cell, 1);
  section.add(-39.0 * cell, 3.0 * cell, true);
  const Fragments with_loose = section.found();
  EXPECT_EQ(with_loose.list.size(), 2U);
  const double particle = section.maker.snapshot.mass[0];
  EXPECT_NEAR(with_loose.of_body[0].loose, 27.0 * particle,
              1e-9 * particle);  // an intact one alone is no fragment
  EXPECT_NEAR(with_loose.of_body[0].connected, 210.0 * particle, 1e-9 * particle);
  const Quantities row = piece_measures(with_loose, one_body);
  EXPECT_EQ(row[0].value, 2.0);
  EXPECT_NEAR(row[1].value, 105.0 * particle, 1e-9 * particle);
  EXPECT_NEAR(row[2].value, 27.0 / 237.0, 1e-12);
}

TEST(Pieces, FailedParticlesOnAMirrorPlaneConnectNothing) {
  Section section;
  section.frame.cuts = {{0, 0.0}};
  section.square(1.25e-3, 0.0, 6);
  for (int j = 0; j < 6; ++j) section.add(0.25e-3, half * j, true);  // a crack in the plane
  const Fragments apart = section.found();
  ASSERT_EQ(apart.list.size(), 1U);
  EXPECT_EQ(apart.list[0].copies, 2.0);
  EXPECT_EQ(apart.list[0].particles, 42U);
  EXPECT_EQ(apart.of_body[0].pieces, 2.0);
  EXPECT_NEAR(apart.list[0].velocity.x(), apart.list[0].position.x(), 1e-15);

  // Two particles and their images are four.
  Section pair;
  pair.frame.cuts = {{0, 0.0}};
  pair.add(0.25e-3, 0.0);
  pair.add(0.25e-3, half);
  EXPECT_EQ(pair.found().list.size(), 1U);
  EXPECT_EQ(pair.found().of_body[0].pieces, 1.0);
  pair.frame.cuts.clear();
  EXPECT_TRUE(pair.found().list.empty());
}

TEST(Pieces, AreUnknownWithoutTheFieldOfFailure) {
  Section section;
  section.square(0.0, 0.0, 10);
  section.maker.snapshot.scalars.erase("failed");
  const Fragments found = section.found();
  EXPECT_TRUE(found.list.empty());
  const Quantities row = piece_measures(found, one_body);
  ASSERT_EQ(row.size(), 6U);
  for (const Quantity& quantity : row) {
    EXPECT_TRUE(std::isnan(quantity.value)) << quantity.name;
    EXPECT_NE(quantity.reason.find("no field \"failed\""), std::string::npos) << quantity.reason;
  }
  EXPECT_EQ(pieces_by_distance(section.maker.snapshot, one_body, section.frame, cell)["pieces"],
            (std::vector<double>{1.0, 1.0, 1.0}));
}

// Of what lies still nothing says along which axis it flies: the cuts do not depend on it.
TEST(Pieces, AreCutByEveryMirrorPlaneButWallsAndSidesOfASlice) {
  Maker maker(half);
  maker.add(Vector3::Constant(2e-3), Vector3::Zero());
  analysis::Run run;
  run.bodies.resize(1);
  const auto mirror = [&](std::size_t axis, std::size_t side, double position) {
    run.walls[axis][side] = {.position = position, .holds = true};
    run.mirror_planes[axis] = run.walls[axis][0] ? run.walls[axis][0]->position : position;
  };
  const auto axes = [&](const Snapshot& last) {
    std::vector<int> found;
    for (const Plane& plane : find_frame(run, maker.snapshot, {}, &last).cuts) found.push_back(plane.axis);
    return found;
  };
  mirror(0, 0, 0.0);
  mirror(1, 0, 0.0);
  mirror(2, 0, 0.0);
  mirror(2, 1, 5e-3);  // a slice
  for (int axis = 0; axis < 3; ++axis) {
    Snapshot last = maker.snapshot;
    last.velocity[0][axis] = 1e-12;
    EXPECT_EQ(axes(last), (std::vector<int>{0, 1})) << "moves along " << axis;
  }
  run.bodies[0].velocity = Vector3(-100.0, 0.0, 0.0);  // against the plane x = 0: a wall
  EXPECT_EQ(axes(maker.snapshot), (std::vector<int>{1}));
}

TEST(Pieces, AGasHasNone) {
  Section section;
  section.square(0.0, 0.0, 10);
  std::vector<BodyInput> gas(1);
  gas[0].name = "gas";
  gas[0].condensed = false;
  const Fragments found = find_fragments(section.maker.snapshot, gas, section.frame, 1.5 * cell);
  EXPECT_TRUE(found.list.empty());
  EXPECT_TRUE(std::isnan(piece_measures(found, gas)[0].value));
}

/// Points on a fine lattice, so that equal distances are exactly equal, whatever is added to all of them.
struct Cloud {
  std::vector<Vector3> points;
  std::vector<bool> failed;
};

Cloud random_cloud(unsigned seed, bool flat) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> coordinate(0, flat ? 400 : 100), of_ten(0, 9);
  Cloud cloud;
  for (int i = 0; i < 1200; ++i) {
    Vector3 place(coordinate(random), coordinate(random), flat ? 0 : coordinate(random));
    if (i % 300 == 0) place *= i % 600 == 0 ? 50.0 : -50.0;  // beyond all others
    cloud.points.push_back(place / 1024.0);
    cloud.failed.push_back(i % 300 == 0 || of_ten(random) < 4);
  }
  return cloud;
}

/// Pieces by the words of the definition, from all pairs.
std::vector<std::uint32_t> by_definition(const Cloud& cloud, double distance) {
  const std::size_t n = cloud.points.size();
  const auto apart = [&](std::size_t i, std::size_t j) { return (cloud.points[i] - cloud.points[j]).norm(); };
  std::vector<std::uint32_t> piece(n, loose);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (cloud.failed[i] || piece[i] != loose) continue;
    std::vector<std::size_t> reached{i};
    piece[i] = i;
    while (!reached.empty()) {
      const std::size_t k = reached.back();
      reached.pop_back();
      for (std::size_t j = 0; j < n; ++j) {
        if (cloud.failed[j] || piece[j] != loose || !(apart(k, j) < distance)) continue;
        piece[j] = i;
        reached.push_back(j);
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!cloud.failed[i]) continue;
    std::vector<std::size_t> near;
    for (std::size_t j = 0; j < n; ++j) {
      if (!cloud.failed[j] && apart(i, j) < distance) near.push_back(j);
    }
    const auto least = std::ranges::min_element(near, {}, [&](std::size_t j) {
      const Vector3& p = cloud.points[j];
      return std::tuple((p - cloud.points[i]).squaredNorm(), p.x(), p.y(), p.z());
    });
    if (least != near.end()) piece[i] = piece[*least];
  }
  return piece;
}

TEST(Pieces, OfRandomPointsAgreeWithTheDefinitionInAnyOrderPlaceAndThreads) {
  const int threads = parallel::threads();
  for (const bool flat : {true, false}) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const Cloud cloud = random_cloud(seed, flat);
      const double distance = flat ? 0.0105 : 0.009;
      const std::vector<std::uint32_t> expected = by_definition(cloud, distance);
      const std::size_t pieces = std::set(expected.begin(), expected.end()).size();
      EXPECT_GT(pieces, 50U);
      EXPECT_LT(pieces, 1100U);
      EXPECT_GT(std::ranges::count(expected, loose), 4);
      for (const int n : {1, 2, 4}) {
        parallel::set_threads(n);
        EXPECT_EQ(pieces_of(cloud.points, cloud.failed, distance), expected) << n << " threads";
      }
      parallel::set_threads(threads);

      Cloud shifted = cloud;
      for (Vector3& p : shifted.points) p += Vector3(17.0, -3.0, 0.5);
      EXPECT_EQ(pieces_of(shifted.points, cloud.failed, distance), expected);

      std::vector<std::size_t> order(cloud.points.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::ranges::shuffle(order, std::mt19937_64(seed));
      Cloud shuffled;
      for (const std::size_t i : order) {
        shuffled.points.push_back(cloud.points[i]);
        shuffled.failed.push_back(cloud.failed[i]);
      }
      const std::vector<std::uint32_t> found = pieces_of(shuffled.points, shuffled.failed, distance);
      std::map<std::uint32_t, std::uint32_t> name;  // of a piece in one order, by that in the other
      for (std::size_t k = 0; k < order.size(); ++k) {
        const std::uint32_t other = name.try_emplace(expected[order[k]], found[k]).first->second;
        EXPECT_EQ(found[k], other);
        EXPECT_EQ(found[k] == loose, expected[order[k]] == loose);
      }
      EXPECT_EQ(std::set(found.begin(), found.end()).size(), pieces);
    }
  }
}

TEST(FragmentSizes, AreQuantilesOfTheMassThatKeepsASize) {
  Maker maker(1e-3);
  EXPECT_TRUE(fragment_size_measures(maker.snapshot, one_body).empty());  // not written
  std::vector<double>& size = maker.snapshot.scalars["fragment_size"];
  for (int i = 1; i <= 100; ++i) {
    maker.add(Vector3(0, 0, 0.01 * i), Vector3::Zero(), 0);
    size.push_back(1e-5 * (i % 2 == 0 ? i : 0));  // every other one has not failed
  }
  maker.add(Vector3::Zero(), Vector3::Zero(), 1);
  size.push_back(0.0);
  std::vector<BodyInput> bodies(2);
  bodies[0].name = "cloud";
  bodies[1].name = "wall";
  const Quantities found = fragment_size_measures(maker.snapshot, bodies);
  EXPECT_NEAR(value(found, "fragment_size_16.cloud"), 1.6e-4, 2.1e-5);
  EXPECT_NEAR(value(found, "fragment_size.cloud"), 5.0e-4, 2.1e-5);
  EXPECT_NEAR(value(found, "fragment_size_84.cloud"), 8.4e-4, 2.1e-5);
  EXPECT_TRUE(std::isnan(value(found, "fragment_size.wall")));
  maker.snapshot.mass[99] *= 1e6;  // the largest size has nearly all of the mass
  EXPECT_NEAR(value(fragment_size_measures(maker.snapshot, bodies), "fragment_size_16.cloud"), 1e-3, 1e-9);
}

}  // namespace
}  // namespace whipple::analysis

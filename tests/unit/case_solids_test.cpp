// SPDX-License-Identifier: BSD-3-Clause
// Prisms, turned polygons, stretched shapes and rows of copies: volumes in closed form against counted points.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "src/core/base/random_bits.hpp"
#include "tests/unit/shape_support.hpp"

namespace whipple::cases::shape_test {

const char* const hexagon =
    R"({ prism = { base = ["1 m", "0 m", "0 m"], axis = "x", sides = 6, inner_radius = "1 m", height = "2 m" } })";
/// An L of three unit squares.
const char* const bracket =
    R"({ extrude = { base = ["0 m", "0 m", "1 m"], first = ["0 m", "2 m", "2 m", "1 m", "1 m", "0 m"],
         second = ["0 m", "0 m", "1 m", "1 m", "2 m", "2 m"], height = "3 m" } })";
const char* const ring =
    R"({ revolve = { base = ["0 m", "0 m", "0 m"], axis = "y", along = ["0 m", "1 m", "1 m", "0 m"],
         radius = ["2 m", "2 m", "3 m", "3 m"] } })";

void expect_volume(const std::string& text, double volume) {
  const auto shape = shape_of(text);
  EXPECT_NEAR(shape->volume(), volume, 1e-9 * volume) << text;
  EXPECT_NEAR(counted(*shape, widened(shape->bounds())), volume, 0.01 * volume) << text;
  EXPECT_EQ(shape_of(shape->toml())->toml(), shape->toml());
}

TEST(Solids, PolygonsBecomePrismsAndRings) {
  expect_volume(hexagon, 6.0 * std::tan(std::numbers::pi / 6.0) * 2.0);
  expect_volume(
      R"({ prism = { base = ["0 m", "0 m", "0 m"], sides = 3, inner_radius = "1 m", height = "1 m" } })",
      3.0 * std::sqrt(3.0));
  expect_volume(bracket, 9.0);
  expect_volume(ring, std::numbers::pi * (9.0 - 4.0));
  // A cone is a turned triangle.
  expect_volume(
      R"({ revolve = { base = ["0 m", "0 m", "0 m"], along = ["0 m", "2 m", "0 m"], radius = ["0 m", "0 m", "1 m"] } })",
      2.0 / 3.0 * std::numbers::pi);
  const auto shape = shape_of(bracket);
  EXPECT_TRUE(shape->contains({1.5, 0.5, 2.0}));
  EXPECT_FALSE(shape->contains({1.5, 1.5, 2.0}));
  EXPECT_TRUE(shape_of(hexagon)->contains({2.0, 0.99, 0.0}));
  EXPECT_FALSE(shape_of(hexagon)->contains({2.0, 1.01, 0.0}));
}

TEST(Solids, StretchedSpheresAreEllipsoids) {
  const std::string ball = R"({ sphere = { center = ["1 m", "0 m", "0 m"], radius = "1 m" } })";
  expect_volume(
      "{ scaled = { factors = [2, 1, 0.5], center = [\"1 m\", \"0 m\", \"0 m\"], shape = " + ball + " } }",
      4.0 / 3.0 * std::numbers::pi);
  const auto shape = shape_of("{ scaled = { factors = [2, 1, 0.5], shape = " + ball + " } }");
  EXPECT_TRUE(shape->contains({3.9, 0, 0}));
  EXPECT_FALSE(shape->contains({4.1, 0, 0}));
  EXPECT_FALSE(shape->contains({2.0, 0, 0.6}));
}

TEST(Solids, ArraysAreRowsOfCopies) {
  const std::string ball = R"({ sphere = { center = ["0 m", "0 m", "0 m"], radius = "1 m" } })";
  const std::string row =
      "{ array = { count = 4, step = [\"0 m\", \"-3 m\", \"0.5 m\"], shape = " + ball + " } }";
  expect_volume(row, 16.0 / 3.0 * std::numbers::pi);
  const auto shape = shape_of(row);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(shape->contains({0.5, -3.0 * i, 0.5 * i}), i < 4) << i;
  // An array of an array fills a plane.
  const auto plane =
      shape_of("{ array = { count = 3, step = [\"3 m\", \"0 m\", \"0 m\"], shape = " + row + " } }");
  EXPECT_TRUE(plane->contains({6.0, -9.0, 1.5}));
  EXPECT_NEAR(plane->volume(), 16.0 * std::numbers::pi, 1e-9);
  // Copies that overlap are counted once.
  const auto close =
      shape_of("{ array = { count = 2, step = [\"0.01 m\", \"0 m\", \"0 m\"], shape = " + ball + " } }");
  EXPECT_NEAR(close->volume(), 4.0 / 3.0 * std::numbers::pi, 0.03 * 4.19);
}

TEST(Solids, WhatHasNoMeaningIsRefused) {
  const std::string ball = R"({ sphere = { center = ["0 m", "0 m", "0 m"], radius = "1 m" } })";
  expect_refused(
      R"({ extrude = { base = ["0 m", "0 m", "0 m"], first = ["0 m", "1 m"], second = ["0 m", "1 m"], height = "1 m" } })",
      "at least three corners");
  expect_refused(
      R"({ extrude = { base = ["0 m", "0 m", "0 m"], first = ["0 m", "1 m", "2 m"], second = ["0 m", "1 m"], height = "1 m" } })",
      "differ in length");
  expect_refused(
      R"({ revolve = { base = ["0 m", "0 m", "0 m"], along = ["0 m", "1 m", "2 m"], radius = ["1 m", "1 m", "1 m"] } })",
      "no area");
  expect_refused("{ array = { count = 2, step = [\"0 m\", \"0 m\", \"0 m\"], shape = " + ball + " } }",
                 "must not be zero");
  expect_refused(
      R"({ array = { count = 2, step = ["1 m", "0 m", "0 m"], shape = { half_space = { point = ["0 m", "0 m", "0 m"], normal = [0, 0, 1] } } } })",
      "has no end");
  expect_refused(
      R"({ extrude = { base = ["0 m", "0 m", "0 m"], first = ["0 m", "2 m", "2 m", "1 m", "0 m"],
           second = ["0 m", "2 m", "0 m", "0 m", "2 m"], height = "1 m" } })",
      "the edges from corner 1 to 2 and from corner 4 to 5 cross");
  expect_refused(
      "{ array = { count = 1000000, step = [\"1e-6 m\", \"0 m\", \"0 m\"], shape = " + ball + " } }",
      "'step' is so short that 1e+06 copies reach each place; at most 1000");
  expect_refused("{ scaled = { factors = [1, 0, 1], shape = " + ball + " } }", "factors");
}

/// Relative densities of generated structures, counted at random points, over sizes and seeds.
TEST(Solids, FoamsHaveTheDensityAskedFor) {
  for (const char* structure : {"kelvin", "voronoi"}) {
    for (const char* form : {"open", "closed"}) {
      for (const double density : {0.03, 0.3}) {
        const int seeds = std::string(structure) == "kelvin" ? 1 : 2;
        for (int seed = 1; seed <= seeds; ++seed) {
          const std::string text = fmt::format(
              R"({{ foam = {{ lower = ["0 m", "0 m", "0 m"], upper = ["4 m", "3 m", "5 m"], cell = "{} m",
                   structure = "{}", form = "{}", relative_density = {}, seed = {} }} }})",
              seed == 1 ? 1.0 : 0.7, structure, form, density, seed);
          const auto shape = shape_of(text);
          EXPECT_NEAR(counted(*shape, shape->bounds(), 100000), density * 60.0, 0.05 * density * 60.0)
              << text;
          EXPECT_NEAR(shape->volume(), density * 60.0, 1e-9);
          EXPECT_GT(shape->smallest_extent(Vector3::UnitX()), 0.0);
          EXPECT_EQ(shape_of(shape->toml())->toml(), shape->toml());
        }
      }
    }
  }
}

/// No point is inside within a distance at which the shape says that none is; it says so of most of a thin foam.
TEST(Solids, FoamsKnowWhereTheyHaveNoMaterial) {
  for (const char* structure : {"kelvin", "voronoi"}) {
    for (const char* form : {"open", "closed"}) {
      const auto foam = shape_of(fmt::format(
          R"({{ foam = {{ lower = ["0 m", "0 m", "0 m"], upper = ["4 m", "4 m", "4 m"], cell = "1 m",
               structure = "{}", form = "{}", relative_density = 0.05, seed = 3 }} }})",
          structure, form));
      std::size_t empty = 0, number = 0;
      const auto next = [&number] {
        ++number;
        return Vector3(uniform(7, 3 * number), uniform(7, 3 * number + 1), uniform(7, 3 * number + 2));
      };
      constexpr double radius = 0.06;
      for (int place = 0; place < 4000; ++place) {
        const Vector3 center = 4.0 * next();
        if (foam->may_hold(center, radius)) continue;
        ++empty;
        for (int k = 0; k < 20; ++k) {
          const Vector3 offset = radius * (2.0 * next() - Vector3::Ones());
          EXPECT_FALSE(offset.norm() <= radius && foam->contains(center + offset));
        }
      }
      EXPECT_GT(empty, std::string(form) == "open" ? 2000U : 800U)
          << structure << " " << form << " " << empty;
      EXPECT_TRUE(foam->may_hold({2.0, 2.0, 2.0}, 10.0));
    }
  }
}

/// Walls of a closed Kelvin foam lie on the faces of truncated octahedra, whose area per volume is 3.3476 over the edge
/// of the cube of two cells (Thomson 1887).
TEST(Solids, WallsOfKelvinCellsHaveTheirThickness) {
  const auto shape = shape_of(
      R"({ foam = { lower = ["0 m", "0 m", "0 m"], upper = ["5 m", "5 m", "5 m"], cell = "0.7937005259840998 m",
           structure = "kelvin", form = "closed", relative_density = 0.02 } })");
  const double face_area_per_volume = (0.5 + std::sqrt(3.0)) * 1.5;  // of faces shared by two cells, edge 1 m
  EXPECT_NEAR(shape->smallest_extent(Vector3::UnitX()), 0.02 / face_area_per_volume, 3e-4);
  // Half way between the seeds (0,0,0) and (1,0,0), and between (0,0,0) and (0.5,0.5,0.5).
  EXPECT_TRUE(shape->contains({2.5, 2.0, 2.0}));
  EXPECT_TRUE(shape->contains({2.25, 2.25, 2.25}));
  EXPECT_FALSE(shape->contains({2.0, 2.0, 2.0}));
}

/// Points in rows would agree with the periods of a lattice: 0.2061 by 96 of them in 3 periods.
TEST(Solids, CountedDensitiesAreFreeOfThePeriod) {
  const auto shape = shape_of(
      R"({ lattice = { lower = ["-9 m", "-9 m", "-9 m"], upper = ["9 m", "9 m", "9 m"], cell = "6 m", kind = "gyroid",
           form = "sheet", relative_density = 0.2 } })");
  double density = 0.0;
  ASSERT_EQ(std::sscanf(shape->account().front().c_str(), "relative density %lf", &density), 1);
  EXPECT_NEAR(density, 0.2, 4e-4);
}

TEST(Solids, LatticesHaveTheDensityAskedFor) {
  for (const char* kind : {"gyroid", "primitive", "diamond"}) {
    for (const char* form : {"sheet", "skeleton"}) {
      const std::string text = fmt::format(
          R"({{ lattice = {{ lower = ["0 m", "0 m", "0 m"], upper = ["4 m", "4 m", "4 m"], cell = "2 m", kind = "{}",
               form = "{}", relative_density = 0.2 }} }})",
          kind, form);
      const auto shape = shape_of(text);
      EXPECT_NEAR(counted(*shape, shape->bounds()), 0.2 * 64.0, 0.02 * 0.2 * 64.0) << text;
      // It repeats after a cell.
      for (int i = 0; i < 1000; ++i) {
        const Vector3 x(0.0021 * i, 1.9 - 0.0017 * i, 0.0005 * i + 0.01);
        ASSERT_EQ(shape->contains(x), shape->contains(x + Vector3(0, 0, 2)));
      }
    }
  }
}

TEST(Solids, PackedSpheresDoNotOverlap) {
  for (const auto& [fraction, spread] : {std::pair(0.2, 0.0), std::pair(0.5, 0.0), std::pair(0.5, 0.3)}) {
    const std::string text = fmt::format(
        R"({{ packing = {{ lower = ["0 m", "0 m", "0 m"], upper = ["8 m", "9 m", "10 m"], radius = "0.5 m", spread = {},
             fraction = {}, seed = 3 }} }})",
        spread, fraction);
    const auto shape = shape_of(text);
    // What is in two spheres would be missing.
    EXPECT_NEAR(counted(*shape, widened(shape->bounds())), fraction * 720.0, 0.01 * fraction * 720.0) << text;
    EXPECT_EQ(shape_of(shape->toml())->toml(), shape->toml());
  }
  expect_refused(
      R"({ packing = { lower = ["0 m", "0 m", "0 m"], upper = ["5 m", "5 m", "5 m"], radius = "0.5 m", fraction = 0.59 } })",
      "is not reached");
  expect_refused(
      R"({ packing = { lower = ["0 m", "0 m", "0 m"], upper = ["1 m", "1 m", "1 m"], radius = "2 m", fraction = 0.3 } })",
      "do not fit this fraction");
  expect_refused(
      R"({ foam = { lower = ["0 m", "0 m", "0 m"], upper = ["1 m", "1 m", "-1 m"], cell = "1 m", structure = "kelvin",
           form = "open", relative_density = 0.1 } })",
      "is empty");
  expect_refused(
      R"({ foam = { lower = ["0 m", "0 m", "0 m"], upper = ["1 m", "1 m", "1 m"], cell = "1 um", structure = "kelvin",
           form = "open", relative_density = 0.1 } })",
      "enlarge 'cell'");
}

}  // namespace whipple::cases::shape_test

// SPDX-License-Identifier: BSD-3-Clause
// Shapes: volumes in closed form against counted points, combinations against set algebra, motion against
// the moved points, and what is refused.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "tests/unit/shape_support.hpp"

namespace whipple::cases {
namespace shape_test {

const char* const sphere = R"({ sphere = { center = ["0 m", "0 m", "0 m"], radius = "1 m" } })";
const char* const box = R"({ box = { lower = ["0 m", "0 m", "0 m"], upper = ["1 m", "2 m", "3 m"] } })";

TEST(Shapes, VolumesOfPrimitivesAreThoseOfTheirPoints) {
  const std::vector<std::string> texts = {
      sphere,
      box,
      R"({ cylinder = { center = ["1 m", "0 m", "0 m"], axis = "y", radius = "1 m", height = "3 m" } })",
      R"({ tube = { base = ["0 m", "0 m", "1 m"], axis = "x", inner_radius = "0.5 m", outer_radius = "1 m", height = "2 m" } })",
      R"({ cone = { base = ["0 m", "0 m", "0 m"], base_radius = "1 m", height = "2 m" } })",
      R"({ cone = { base = ["0 m", "0 m", "0 m"], base_radius = "0.4 m", top_radius = "1 m", height = "2 m" } })",
      R"({ ogive = { base = ["0 m", "0 m", "0 m"], radius = "1 m", nose_length = "2 m", shank_length = "1 m" } })"};
  for (const std::string& text : texts) {
    const std::unique_ptr<Shape> shape = shape_of(text);
    // The bounds hold everything: points of a wider box count the same volume.
    EXPECT_NEAR(counted(*shape, widened(shape->bounds())), shape->volume(), 0.01 * shape->volume()) << text;
  }
}

TEST(Shapes, OgiveIsTangentAtTheShankAndEndsInATip) {
  const auto shape = shape_of(
      R"({ ogive = { base = ["0 m", "0 m", "0 m"], radius = "1 m", nose_length = "3 m", shank_length = "1 m" } })");
  EXPECT_TRUE(shape->contains({0.999, 0, -0.5}));
  EXPECT_TRUE(
      shape->contains({0.999, 0, 0.05}));  // no kink: the radius falls with the square of the distance
  EXPECT_FALSE(shape->contains({0.03, 0, 2.999}));
  EXPECT_TRUE(shape->contains({0.0, 0, 2.999}));
}

TEST(Shapes, CombinationsAreSetAlgebra) {
  const std::string a = sphere, b = box;
  const auto first = shape_of(a), second = shape_of(b);
  const auto both = shape_of("{ union = [" + a + ", " + b + "] }");
  const auto common = shape_of("{ intersection = [" + a + ", " + b + "] }");
  const auto rest = shape_of("{ difference = { from = " + a + ", minus = [" + b + "] } }");
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.5, 3.5);
  for (int i = 0; i < 20000; ++i) {
    const Vector3 x(unit(random), unit(random), unit(random));
    const bool in_a = first->contains(x), in_b = second->contains(x);
    ASSERT_EQ(both->contains(x), in_a || in_b);
    ASSERT_EQ(common->contains(x), in_a && in_b);
    ASSERT_EQ(rest->contains(x), in_a && !in_b);
  }
  EXPECT_NEAR(common->volume(), std::numbers::pi / 6.0, 2e-3);  // an eighth of the sphere
  EXPECT_NEAR(rest->volume(), 7.0 * std::numbers::pi / 6.0, 5e-3);
  EXPECT_NEAR(both->volume(), 6.0 + 7.0 * std::numbers::pi / 6.0, 3e-2);
}

TEST(Shapes, AHalfSpaceCutsAShape) {
  const auto half =
      shape_of(std::string("{ intersection = [") + sphere +
               R"(, { half_space = { point = ["0 m", "0 m", "0 m"], normal = [0, 0, 1] } }] })");
  EXPECT_TRUE(half->contains({0, 0, -0.5}));
  EXPECT_FALSE(half->contains({0, 0, 0.5}));
  EXPECT_NEAR(half->volume(), 2.0 * std::numbers::pi / 3.0, 5e-3);
}

TEST(Shapes, MovedShapesHoldTheMovedPoints) {
  const std::string motion =
      R"(translation = ["1 m", "-2 m", "0.5 m"], axis = [1, 1, 0], angle = "30 degree", center = ["0 m", "1 m", "0 m"])";
  const auto still = shape_of(box);
  const auto moved = shape_of("{ moved = { " + motion + ", shape = " + std::string(box) + " } }");
  const Eigen::Matrix3d rotation(Eigen::AngleAxisd(std::numbers::pi / 6.0, Vector3(1, 1, 0).normalized()));
  const Shape::Bounds bounds = moved->bounds();
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 4.0);
  for (int i = 0; i < 20000; ++i) {
    const Vector3 x(unit(random), unit(random), unit(random));
    const Vector3 y = rotation * (x - Vector3(0, 1, 0)) + Vector3(0, 1, 0) + Vector3(1, -2, 0.5);
    ASSERT_EQ(moved->contains(y), still->contains(x));
    if (still->contains(x)) {
      ASSERT_TRUE((y.array() >= bounds.lower.array()).all() && (y.array() <= bounds.upper.array()).all());
    }
  }
  EXPECT_EQ(moved->volume(), still->volume());
}

TEST(Shapes, WrittenShapesReadBackTheSame) {
  const std::string text =
      "{ difference = { from = { moved = { angle = \"0.3 rad\", shape = " + std::string(box) +
      " } }, minus = [" + sphere + "] } }";
  const std::string written = shape_of(text)->toml();
  EXPECT_EQ(shape_of(written)->toml(), written);
}

TEST(Shapes, WhatHasNoMeaningIsRefused) {
  expect_refused("{ cube = { radius = \"1 m\" } }", "must hold exactly one of: sphere, box");
  expect_refused(R"({ half_space = { point = ["0 m", "0 m", "0 m"], normal = [0, 0, 1] } })", "has no end");
  expect_refused("{ union = [] }", "must be a list of shapes");
  expect_refused("{ union = [{ ball = 1 }] }", "must hold exactly one of");
  expect_refused("{ difference = { from = " + std::string(sphere) + " } }", "minus");
  expect_refused("{ moved = { axis = [0, 0, 0], shape = " + std::string(sphere) + " } }", "must not be zero");
  expect_refused("{ intersection = [" + std::string(sphere) +
                     R"(, { sphere = { center = ["5 m", "0 m", "0 m"], radius = "1 m" } }] })",
                 "is empty");
}

}  // namespace shape_test
}  // namespace whipple::cases

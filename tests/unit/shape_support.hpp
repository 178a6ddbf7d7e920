// SPDX-License-Identifier: BSD-3-Clause
// Shapes from their texts, and what their points tell.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>

#include "src/case/shapes/shape.hpp"
#include "src/core/base/error.hpp"

namespace whipple::cases::shape_test {

/// @param text  may be broken into lines, which an inline table may not
inline std::unique_ptr<Shape> shape_of(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  input::Document document = input::Document::from_text("shape = " + text + "\n", "case.toml");
  input::Table root = document.root();
  std::unique_ptr<Shape> shape = read_shape(root);
  document.finish();
  return shape;
}

inline void expect_refused(const std::string& text, const std::string& reason) {
  try {
    shape_of(text);
    ADD_FAILURE() << text << " was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
  }
}

/// Share of random points of a box (m) that lie inside, times its volume.
inline double counted(const Shape& shape, const Shape::Bounds& box, int points = 400000) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit;
  int inside = 0;
  for (int i = 0; i < points; ++i) {
    const Vector3 u(unit(random), unit(random), unit(random));
    inside += shape.contains(box.lower + u.cwiseProduct(box.upper - box.lower)) ? 1 : 0;
  }
  return (box.upper - box.lower).prod() * inside / points;
}

inline Shape::Bounds widened(const Shape::Bounds& box) {
  const Vector3 margin = 0.1 * (box.upper - box.lower);
  return {box.lower - margin, box.upper + margin};
}

}  // namespace whipple::cases::shape_test

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "src/case/shapes/axis.hpp"
#include "src/case/shapes/polygon.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/shape.hpp"

namespace whipple::cases {

/// Describes a prism over any polygon.
class Extrude final : public Shape, public Revolution {
 public:
  static constexpr const char* name = "extrude";
  static constexpr const char* summary = "prism over a polygon, whose corners are listed in either sense";

  static ParameterTable<Extrude> parameters() {
    ParameterTable<Extrude> table =
        Revolution::parameters<Extrude>("origin of the corners, at the lower end");
    table.push_back(real_list("first", &Extrude::first_, "m", range::any(),
                              "corners, along the axis behind that of the prism: of z, along x"));
    table.push_back(
        real_list("second", &Extrude::second_, "m", range::any(), "corners, along the axis behind that"));
    table.push_back(real("height", &Extrude::height_, "m", range::positive(), "length along the axis"));
    return table;
  }
  /// Completes the shape. @returns why its keys are not valid, or an empty text
  std::string settle() { return polygon_.set(first_, second_); }

  [[nodiscard]] bool contains(const Vector3& point) const override {
    const Vector3 offset = point - base;
    return offset[index()] > 0.0 && offset[index()] < height_ &&
           polygon_.contains(offset[(index() + 1) % 3], offset[(index() + 2) % 3]);
  }
  [[nodiscard]] Bounds bounds() const override {
    Vector3 lower = base, upper = base;
    lower[(index() + 1) % 3] += *std::ranges::min_element(first_);
    upper[(index() + 1) % 3] += *std::ranges::max_element(first_);
    lower[(index() + 2) % 3] += *std::ranges::min_element(second_);
    upper[(index() + 2) % 3] += *std::ranges::max_element(second_);
    upper[index()] += height_;
    return {lower, upper};
  }
  [[nodiscard]] double volume() const override { return polygon_.area() * height_; }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(*this); }

 private:
  std::vector<double> first_, second_;
  double height_ = 1.0;
  Polygon polygon_;
};

}  // namespace whipple::cases

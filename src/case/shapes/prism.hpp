// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include "src/case/shapes/axis.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/shape.hpp"

namespace whipple::cases {

/// Describes a regular prism; one of its faces is normal to the axis behind its own: of z, x.
class Prism final : public Shape, public Revolution {
 public:
  static constexpr const char* name = "prism";
  static constexpr const char* summary = "regular prism: a hexagonal bar, for instance";

  static ParameterTable<Prism> parameters() {
    ParameterTable<Prism> table = Revolution::parameters<Prism>("centre of the lower end");
    table.push_back(integer("sides", &Prism::sides_, range::between(3, 1000), "number of sides"));
    table.push_back(real("inner_radius", &Prism::radius_, "m", range::positive(),
                         "distance of the sides from the axis: half of the width across flats"));
    table.push_back(real("height", &Prism::height_, "m", range::positive(), "length along the axis"));
    return table;
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    const Vector3 offset = point - base;
    const double along = offset[index()];
    const double x = offset[(index() + 1) % 3], y = offset[(index() + 2) % 3];
    const double sector = 2.0 * half_angle();
    const double from_face = std::remainder(std::atan2(y, x), sector);
    return along > 0.0 && along < height_ && std::hypot(x, y) * std::cos(from_face) < radius_;
  }
  [[nodiscard]] Bounds bounds() const override {
    const double corner = radius_ / std::cos(half_angle());
    double lower_x = 0.0, lower_y = 0.0, upper_x = 0.0, upper_y = 0.0;
    for (std::int64_t i = 0; i < sides_; ++i) {
      const double angle = (2.0 * static_cast<double>(i) + 1.0) * half_angle();
      lower_x = std::min(lower_x, corner * std::cos(angle));
      upper_x = std::max(upper_x, corner * std::cos(angle));
      lower_y = std::min(lower_y, corner * std::sin(angle));
      upper_y = std::max(upper_y, corner * std::sin(angle));
    }
    Vector3 lower = base, upper = base;
    lower[(index() + 1) % 3] += lower_x;
    upper[(index() + 1) % 3] += upper_x;
    lower[(index() + 2) % 3] += lower_y;
    upper[(index() + 2) % 3] += upper_y;
    upper[index()] += height_;
    return {lower, upper};
  }
  [[nodiscard]] double volume() const override {
    return static_cast<double>(sides_) * radius_ * radius_ * std::tan(half_angle()) * height_;
  }
  [[nodiscard]] double smallest_extent(const Vector3&) const override {
    return std::min(2.0 * radius_, height_);
  }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(*this); }

 private:
  [[nodiscard]] double half_angle() const { return std::numbers::pi / static_cast<double>(sides_); }
  std::int64_t sides_ = 6;
  double radius_ = 1.0, height_ = 1.0;
};

}  // namespace whipple::cases

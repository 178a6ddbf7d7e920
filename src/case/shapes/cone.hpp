// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numbers>

#include "src/case/shapes/axis.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/shape.hpp"

namespace whipple::cases {

/// Describes a circular cone or truncated cone.
class Cone final : public Shape, public Revolution {
 public:
  static constexpr const char* name = "cone";
  static constexpr const char* summary = "circular cone or truncated cone";

  Cone() = default;
  Cone(const Vector3& base, Axis axis, double base_radius, double top_radius, double height)
      : Revolution{base, axis}, base_radius_(base_radius), top_radius_(top_radius), height_(height) {}

  static ParameterTable<Cone> parameters() {
    ParameterTable<Cone> table = Revolution::parameters<Cone>("centre of the base");
    table.push_back(real("base_radius", &Cone::base_radius_, "m", range::positive(), "radius at the base"));
    table.push_back(real("top_radius", &Cone::top_radius_, "m", range::non_negative(),
                         "radius at the other end (0: a tip)")
                        .optional());
    table.push_back(real("height", &Cone::height_, "m", range::positive(), "length along the axis"));
    return table;
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    const Place p = place(point);
    return p.along > 0.0 && p.along < height_ &&
           p.radius < base_radius_ + (top_radius_ - base_radius_) * p.along / height_;
  }
  [[nodiscard]] Bounds bounds() const override {
    return Revolution::bounds(0.0, height_, std::max(base_radius_, top_radius_));
  }
  [[nodiscard]] double volume() const override {
    return std::numbers::pi / 3.0 * height_ *
           (base_radius_ * base_radius_ + base_radius_ * top_radius_ + top_radius_ * top_radius_);
  }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(*this); }

 private:
  double base_radius_ = 1.0, top_radius_ = 0.0, height_ = 1.0;
};

}  // namespace whipple::cases

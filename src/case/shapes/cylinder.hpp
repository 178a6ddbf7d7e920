// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/case/shapes/axis.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/shape.hpp"
#include "src/case/shapes/structured.hpp"
#include "src/fem/structured.hpp"

namespace whipple::cases {

/// Describes a solid circular cylinder.
class Cylinder final : public Shape {
 public:
  static constexpr const char* name = "cylinder";
  static constexpr const char* summary = "solid circular cylinder";

  Cylinder() = default;
  Cylinder(const Vector3& center, Axis axis, double radius, double height)
      : center_(center), axis_(axis), radius_(radius), height_(height) {}

  static ParameterTable<Cylinder> parameters() {
    return {vector("center", &Cylinder::center_, "m", range::any(), "centre, at half height"),
            choice("axis", &Cylinder::axis_, "direction of the axis").is_axis().optional(),
            real("radius", &Cylinder::radius_, "m", range::positive(), "radius"),
            real("height", &Cylinder::height_, "m", range::positive(), "length along the axis")};
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    Vector3 offset = point - center_;
    const double along = offset[axis()];
    offset[axis()] = 0.0;
    return std::abs(along) < 0.5 * height_ && offset.squaredNorm() < radius_ * radius_;
  }
  [[nodiscard]] Bounds bounds() const override {
    Vector3 half = Vector3::Constant(radius_);
    half[axis()] = 0.5 * height_;
    return {center_ - half, center_ + half};
  }
  [[nodiscard]] double volume() const override { return std::numbers::pi * radius_ * radius_ * height_; }
  [[nodiscard]] double smallest_extent(const Vector3&) const override {
    return std::min(2.0 * radius_, height_);
  }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(*this); }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    Vector3 base = center_;
    base[axis()] -= 0.5 * height_;
    return mesh_of_revolution(base, axis(), height_, radius_, clip,
                              [&](double length, const fem::Halved& halved) {
                                return fem::make_cylinder(radius_, length, size, halved);
                              });
  }

 private:
  [[nodiscard]] Eigen::Index axis() const { return index_of(axis_); }
  Vector3 center_ = Vector3::Zero();
  Axis axis_ = Axis::z;
  double radius_ = 1.0;
  double height_ = 1.0;
};

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/shape.hpp"
#include "src/case/shapes/structured.hpp"
#include "src/fem/structured.hpp"

namespace whipple::cases {

/// Describes a solid sphere; lengths in m, as in all shapes.
class Sphere final : public Shape {
 public:
  static constexpr const char* name = "sphere";
  static constexpr const char* summary = "solid sphere";

  Sphere() = default;
  Sphere(const Vector3& center, double radius) : center_(center), radius_(radius) {}

  static ParameterTable<Sphere> parameters() {
    return {vector("center", &Sphere::center_, "m", range::any(), "centre of the sphere"),
            real("radius", &Sphere::radius_, "m", range::positive(), "radius")};
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return (point - center_).squaredNorm() < radius_ * radius_;
  }
  [[nodiscard]] Bounds bounds() const override {
    const Vector3 half = Vector3::Constant(radius_);
    return {center_ - half, center_ + half};
  }
  [[nodiscard]] double volume() const override {
    return 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_;
  }
  [[nodiscard]] double smallest_extent(const Vector3&) const override { return 2.0 * radius_; }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(*this); }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    fem::Halved halved{};
    Matrix3 turn = Matrix3::Identity();
    for (int a = 0; a < 3; ++a) {
      const int half = half_within(clip, a, center_[a], radius_);
      halved[static_cast<std::size_t>(a)] = half != 0;
      if (half < 0) turn(a, a) = -1.0;
    }
    fem::Hexahedra mesh = fem::make_sphere(radius_, size, halved);
    fem::transform(mesh, turn, center_);
    return mesh;
  }

 private:
  Vector3 center_ = Vector3::Zero();
  double radius_ = 1.0;
};

}  // namespace whipple::cases

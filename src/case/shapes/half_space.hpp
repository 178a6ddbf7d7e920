// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/shape.hpp"

namespace whipple::cases {

/// Describes all points on one side of a plane.
class HalfSpace final : public Shape {
 public:
  static constexpr const char* name = "half_space";
  static constexpr const char* summary =
      "everything on one side of a plane; for intersections and differences";

  HalfSpace() = default;
  HalfSpace(const Vector3& point, const Vector3& normal) : point_(point), normal_(normal) {}

  static ParameterTable<HalfSpace> parameters() {
    return {vector("point", &HalfSpace::point_, "m", range::any(), "a point of the face"),
            vector("normal", &HalfSpace::normal_, "", range::any(), "outward direction, any length")};
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return normal_.dot(point - point_) < 0.0;
  }
  [[nodiscard]] Bounds bounds() const override {
    const Vector3 everywhere = Vector3::Constant(std::numeric_limits<double>::infinity());
    return {-everywhere, everywhere};
  }
  [[nodiscard]] double volume() const override { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(*this); }

 private:
  Vector3 point_ = Vector3::Zero();
  Vector3 normal_ = Vector3::UnitZ();
};

}  // namespace whipple::cases

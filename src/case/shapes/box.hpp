// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/shape.hpp"
#include "src/fem/structured.hpp"

namespace whipple::cases {

/// Describes a box aligned with the axes.
class Box final : public Shape {
 public:
  static constexpr const char* name = "box";
  static constexpr const char* summary = "box along the axes";

  Box() = default;
  Box(const Vector3& lower, const Vector3& upper) : lower_(lower), upper_(upper) {}

  static ParameterTable<Box> parameters() {
    return {vector("lower", &Box::lower_, "m", range::any(), "corner with the smallest coordinates")
                .in_plane(-0.5),
            vector("upper", &Box::upper_, "m", range::any(), "corner with the largest coordinates")
                .in_plane(0.5)};
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return (point.array() > lower_.array()).all() && (point.array() < upper_.array()).all();
  }
  [[nodiscard]] Bounds bounds() const override { return {lower_, upper_}; }
  [[nodiscard]] double volume() const override { return (upper_ - lower_).prod(); }
  [[nodiscard]] double smallest_extent(const Vector3& direction) const override {
    Eigen::Index along = 0;
    direction.cwiseAbs().maxCoeff(&along);
    return upper_[along] - lower_[along];
  }
  [[nodiscard]] bool fills_lattice() const override { return true; }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(*this); }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    return fem::make_box(lower_.cwiseMax(clip.lower), upper_.cwiseMin(clip.upper), size);
  }

 private:
  Vector3 lower_ = Vector3::Zero();
  Vector3 upper_ = Vector3::Ones();
};

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "src/case/shapes/axis.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/shape.hpp"
#include "src/case/shapes/structured.hpp"
#include "src/fem/structured.hpp"

namespace whipple::cases {

/// Describes a hollow circular cylinder.
class Tube final : public Shape, public Revolution {
 public:
  static constexpr const char* name = "tube";
  static constexpr const char* summary = "hollow circular cylinder";

  Tube() = default;
  Tube(const Vector3& base, Axis axis, double inner_radius, double outer_radius, double height)
      : Revolution{base, axis}, inner_(inner_radius), outer_(outer_radius), height_(height) {}

  static ParameterTable<Tube> parameters() {
    ParameterTable<Tube> table = Revolution::parameters<Tube>("centre of the lower end");
    table.push_back(real("inner_radius", &Tube::inner_, "m", range::positive(), "radius of the hole"));
    table.push_back(real("outer_radius", &Tube::outer_, "m", range::positive(), "outer radius"));
    table.push_back(real("height", &Tube::height_, "m", range::positive(), "length along the axis"));
    return table;
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    const Place p = place(point);
    return p.along > 0.0 && p.along < height_ && p.radius > inner_ && p.radius < outer_;
  }
  [[nodiscard]] Bounds bounds() const override { return Revolution::bounds(0.0, height_, outer_); }
  [[nodiscard]] double volume() const override {
    return std::numbers::pi * (outer_ * outer_ - inner_ * inner_) * height_;
  }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(*this); }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    return mesh_of_revolution(base, index(), height_, outer_, clip,
                              [&](double length, const fem::Halved& halved) {
                                return fem::make_tube(inner_, outer_, length, size, halved);
                              });
  }

 private:
  double inner_ = 0.5, outer_ = 1.0, height_ = 1.0;
};

}  // namespace whipple::cases

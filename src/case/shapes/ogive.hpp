// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include "src/case/shapes/axis.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/shape.hpp"
#include "src/case/shapes/structured.hpp"
#include "src/fem/structured.hpp"

namespace whipple::cases {

/// Describes a tangent ogive: the arc of radius rho = (R^2 + L^2)/(2 R) is tangent to the shank; the calibre of the
/// nose is rho/(2 R).
class Ogive final : public Shape, public Revolution {
 public:
  static constexpr const char* name = "ogive";
  static constexpr const char* summary = "tangent ogive with a shank: the nose of a projectile";

  Ogive() = default;
  Ogive(const Vector3& base, Axis axis, double radius, double nose_length, double shank_length)
      : Revolution{base, axis}, radius_(radius), nose_(nose_length), shank_(shank_length) {}

  static ParameterTable<Ogive> parameters() {
    ParameterTable<Ogive> table = Revolution::parameters<Ogive>("centre of the base of the nose");
    table.push_back(real("radius", &Ogive::radius_, "m", range::positive(), "R, radius of the shank"));
    table.push_back(
        real("nose_length", &Ogive::nose_, "m", range::positive(), "L, along the axis; at least R"));
    table.push_back(real("shank_length", &Ogive::shank_, "m", range::non_negative(),
                         "length of the cylinder behind the base")
                        .optional());
    return table;
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    const Place p = place(point);
    if (p.along <= -shank_ || p.along >= nose_) return false;
    return p.radius < (p.along < 0.0 ? radius_ : std::sqrt(arc() * arc() - p.along * p.along) - depth());
  }
  [[nodiscard]] Bounds bounds() const override { return Revolution::bounds(-shank_, nose_, radius_); }
  [[nodiscard]] double volume() const override {
    const double r = arc(), d = depth(), l = nose_;
    const double nose = r * r * l - l * l * l / 3.0 + d * d * l -
                        d * (l * std::sqrt(r * r - l * l) + r * r * std::asin(l / r));
    return std::numbers::pi * (nose + radius_ * radius_ * shank_);
  }
  [[nodiscard]] double smallest_extent(const Vector3&) const override { return 2.0 * radius_; }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(*this); }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    Vector3 rear = base;
    rear[index()] -= shank_;
    return mesh_about_axis(rear, index(), radius_, clip, [&](const fem::Halved& halved) {
      return fem::make_ogive(radius_, nose_, shank_, size, halved);
    });
  }

 private:
  [[nodiscard]] double arc() const { return (radius_ * radius_ + nose_ * nose_) / (2.0 * radius_); }
  [[nodiscard]] double depth() const { return arc() - radius_; }
  double radius_ = 1.0, nose_ = 2.0, shank_ = 0.0;
};

}  // namespace whipple::cases

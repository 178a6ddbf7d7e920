// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numbers>

#include "src/case/shapes/axis.hpp"
#include "src/case/shapes/polygon.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/shape.hpp"

namespace whipple::cases {

/// Describes a polygon turned about an axis.
class Revolve final : public Shape, public Revolution {
 public:
  static constexpr const char* name = "revolve";
  static constexpr const char* summary = "polygon turned about an axis: a case, a liner, a nozzle";

  static ParameterTable<Revolve> parameters() {
    ParameterTable<Revolve> table = Revolution::parameters<Revolve>("origin of the corners, on the axis");
    table.push_back(real_list("along", &Revolve::along_, "m", range::any(), "corners, along the axis"));
    table.push_back(
        real_list("radius", &Revolve::corner_radius_, "m", range::non_negative(), "corners, from the axis"));
    return table;
  }
  /// Completes the shape. @returns why its keys are not valid, or an empty text
  std::string settle() { return polygon_.set(corner_radius_, along_); }

  [[nodiscard]] bool contains(const Vector3& point) const override {
    const Place p = place(point);
    return polygon_.contains(p.radius, p.along);
  }
  [[nodiscard]] Bounds bounds() const override {
    return Revolution::bounds(*std::ranges::min_element(along_), *std::ranges::max_element(along_),
                              *std::ranges::max_element(corner_radius_));
  }
  /// Returns the area of the polygon times the path of its centroid (Pappus).
  [[nodiscard]] double volume() const override { return 2.0 * std::numbers::pi * polygon_.first_moment(); }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(*this); }

 private:
  std::vector<double> along_, corner_radius_;
  Polygon polygon_;
};

}  // namespace whipple::cases

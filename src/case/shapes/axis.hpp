// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/case/shapes/shape.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::cases {

/// Selects the direction of an axis of revolution.
enum class Axis : std::uint8_t { x, y, z };
constexpr std::array<Word<Axis>, 3> words(Axis) { return {{{Axis::x, "x"}, {Axis::y, "y"}, {Axis::z, "z"}}}; }
constexpr Eigen::Index index_of(Axis axis) { return static_cast<Eigen::Index>(axis); }

/// Holds the common properties of primitives of revolution.
struct Revolution {
  Vector3 base = Vector3::Zero();
  Axis axis = Axis::z;

  /// Holds the distance along the axis from the base, and the distance from the axis.
  struct Place {
    double along, radius;
  };
  [[nodiscard]] Place place(const Vector3& point) const {
    Vector3 offset = point - base;
    const double along = offset[index()];
    offset[index()] = 0.0;
    return {along, offset.norm()};
  }
  [[nodiscard]] Shape::Bounds bounds(double from, double to, double radius) const {
    Vector3 lower = base - Vector3::Constant(radius), upper = base + Vector3::Constant(radius);
    lower[index()] = base[index()] + from;
    upper[index()] = base[index()] + to;
    return {lower, upper};
  }
  [[nodiscard]] Eigen::Index index() const { return index_of(axis); }

  template <class Owner>
  static ParameterTable<Owner> parameters(const char* meaning_of_base) {
    return {vector<Owner>("base", &Owner::base, "m", range::any(), meaning_of_base),
            choice("axis", static_cast<Axis Owner::*>(&Owner::axis), "direction of the axis")
                .is_axis()
                .optional()};
  }
};

}  // namespace whipple::cases

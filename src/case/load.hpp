// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "src/case/section.hpp"
#include "src/case/time_table.hpp"
#include "src/core/base/tensor.hpp"
#include "src/core/base/words.hpp"
#include "src/grid/geometry.hpp"

namespace whipple::cases {

/// Selects a face of the domain, in the order of grid::Geometry::boundary.
enum class Face : std::uint8_t { x_lower, x_upper, y_lower, y_upper, z_lower, z_upper, none };
constexpr std::array<Word<Face>, 6> words(Face) {
  return {{{Face::x_lower, "x_lower"},
           {Face::x_upper, "x_upper"},
           {Face::y_lower, "y_lower"},
           {Face::y_upper, "y_upper"},
           {Face::z_lower, "z_lower"},
           {Face::z_upper, "z_upper"}}};
}

/// Describes a box along the axes.
struct LoadBox {
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();  ///< m

  static ParameterTable<LoadBox> parameters();
  void check(const Case& setup, const Faults& faults) const;
};

/// Describes the points on which a load acts: those of a body, or of all bodies, in a box.
struct LoadedRegion {
  std::optional<std::size_t> body;
  Vector3 lower, upper;  ///< m

  [[nodiscard]] bool contains(std::size_t of_body, const Vector3& x) const {
    return (!body || *body == of_body) && (x.array() >= lower.array()).all() &&
           (x.array() <= upper.array()).all();
  }
};

/// Describes the plane of a face of the domain.
struct FacePlane {
  int axis;
  double position;  ///< m
  double inward;    ///< 1 or -1: direction into the domain
};

/// Describes an external load: one of an acceleration, a force, a pressure on a wall's patch and a damping, times a
/// factor over time (docs/theory/mpm.md, equations 3.5b to 3.5d).
struct AppliedLoad {
  static constexpr double not_given = std::numeric_limits<double>::infinity();

  std::string body;                        ///< empty: all bodies
  std::optional<LoadBox> box;              ///< none: everywhere
  Vector3 acceleration = Vector3::Zero();  ///< m/s^2
  Vector3 force = Vector3::Zero();         ///< N
  double pressure = not_given;             ///< Pa
  Face face = Face::none;                  ///< with a pressure: on the part of this face inside the box
  double damping = not_given;              ///< 1/s
  TimeTable table;

  static ParameterTable<AppliedLoad> parameters();
  static std::span<const Section<AppliedLoad>> sections();
  void check(const Case& setup, const Faults& faults) const;

  /// Returns the points on which it acts; with a pressure those within a cell of the face.
  [[nodiscard]] LoadedRegion region(const Case& setup) const;
  /// Returns the plane of the face. Requires a face.
  [[nodiscard]] FacePlane plane(const Case& setup) const;
  /// Returns the force (N) at a factor of 1: that of a pressure is pressure times the area of the patch that material
  /// covers at the start, into the domain. Requires geometry and shapes.
  [[nodiscard]] Vector3 total_force(const Case& setup) const;
  [[nodiscard]] bool is_damping() const { return damping != not_given; }
  /// Returns whether the force is distributed over the mass of the region.
  [[nodiscard]] bool is_force() const { return !force.isZero(0.0) || pressure != not_given; }

 private:
  void check_face(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "src/analysis/run.hpp"

namespace whipple::analysis {

/// A plane x_axis = position.
struct Plane {
  int axis = 0;
  double position = 0.0;
};

/// Where the impact is: the frame in which everything is measured.
struct Frame {
  grid::Dimension dimension = grid::Dimension::space;
  int axis = 2;                      ///< of the flight: the direction in which the bodies approach each other
  double sign = 1.0;                 ///< +1: the projectile flies up along the axis
  Vector3 centre = Vector3::Zero();  ///< a point of the axis; its axial coordinate is 0
  double start = 0.0;                ///< axial coordinate of the projectile when its centre is there
  std::vector<Plane> planes;         ///< mirror planes that cut the model out of the full problem
  /// Mirror planes beyond which pieces go on: of each direction the one that there is, whatever the axis. A plane that
  /// the projectile flies against is none, nor are the two sides of a slice.
  std::vector<Plane> cuts;
  std::optional<double>
      wall;                ///< axial coordinate of a wall or mirror plane that the projectile flies against
  bool wall_holds = true;  ///< it is a mirror plane: what touches it stays there
  std::size_t projectile = 0;  ///< the fastest body
  double impact_speed = 0.0;   ///< relative speed of the fastest and the slowest body, m/s
  double parting_speed = 0.0;  ///< where nothing moves at the start: of the fastest body at the end, m/s
  double impact_angle = 0.0;   ///< of their relative velocity with the axis, rad; 0: a normal impact
  Vector3 direction = Vector3::Zero();     ///< of the flight: relative velocity over its axial component
  std::array<int, 2> transverse = {0, 1};  ///< upward in pictures; sight, across the only mirror plane

  [[nodiscard]] bool is_planar() const { return dimension != grid::Dimension::space; }
  /// How many models make the full problem: 4 for a quarter model.
  [[nodiscard]] double copies() const { return static_cast<double>(1U << planes.size()); }
  /// Returns how many times a piece that lies on no cut is in the full problem.
  [[nodiscard]] double images() const { return static_cast<double>(1U << cuts.size()); }
  /// Returns this frame about the point at which the line of flight meets an axial coordinate (m).
  [[nodiscard]] Frame at_face(double coordinate) const;
  /// Returns this frame along another axis of the model, in which the line of flight goes forward too. It must not be
  /// normal to a mirror plane.
  [[nodiscard]] Frame along(int other) const;
  /// Component or coordinate along the flight.
  [[nodiscard]] double axial(const Vector3& v) const { return sign * v[axis]; }
  /// Distance from the axis.
  [[nodiscard]] double radius(const Vector3& position) const;
  /// Returns the axial speed (m/s) above which material is debris (forward) or ejecta (backward).
  [[nodiscard]] double debris_speed() const { return 0.05 * std::max(impact_speed, parting_speed); }
  /// Returns the area of a ring about the axis, m^2; in plane strain of the strips on both sides.
  [[nodiscard]] double ring_area(double inner, double outer) const;
  /// Component of the velocity away from the axis; its magnitude across the axis on the axis itself.
  [[nodiscard]] double radial_speed(const Vector3& position, const Vector3& velocity) const;
  /// Extent (m) of a particle across the plane of two dimensions: the way around the axis of a ring.
  [[nodiscard]] double depth(const Vector3& position) const;
  /// Edge (m) of the square, in three dimensions of the cube, that a particle of volume `volume` (m^3) fills.
  [[nodiscard]] double edge(double volume, const Vector3& position) const;
  /// Returns whether the model ends at a mirror plane in this direction.
  [[nodiscard]] bool mirrored(int direction) const;
};

/// From the velocities of the input, and the place of the projectile in the first snapshot. Where nothing moves
/// at the start, the axis is that along which the bodies part until the last snapshot.
/// @param axis  0, 1, 2 instead of what is found
Frame find_frame(const Run& run, const Snapshot& first, std::optional<int> axis = {},
                 const Snapshot* last = nullptr);

/// Extent of the particles of a body along the axis, half a particle beyond their centres.
struct Extent {
  double lower = 0.0, upper = 0.0;
  [[nodiscard]] double length() const { return upper - lower; }
};
Extent axial_extent(const Snapshot& snapshot, const Frame& frame, std::size_t body, double spacing);

/// Returns the value below which a fraction of the weight lies; NaN without weight. Sorts its argument.
double weighted_quantile(std::vector<std::pair<double, double>>& value_and_weight, double fraction);

}  // namespace whipple::analysis

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "src/analysis/run.hpp"

namespace whipple::analysis {

/// Describes a plane x_axis = position.
struct Plane {
  int axis = 0;
  double position = 0.0;
};

/// Describes the frame of the impact, to which all measures refer.
struct Frame {
  grid::Dimension dimension = grid::Dimension::space;
  int axis = 2;                      ///< of the flight: the direction in which the bodies approach each other
  double sign = 1.0;                 ///< +1: the projectile flies in the positive direction of the axis
  Vector3 centre = Vector3::Zero();  ///< a point of the axis; its axial coordinate is 0
  double start = 0.0;                ///< axial coordinate of the projectile when its centre is at `centre`
  std::vector<Plane> planes;         ///< mirror planes across the axis
  unsigned slices = 0;  ///< number of `planes` that are one of the two sides of a slice and halve nothing
  /// Holds the mirror planes across which pieces continue, at most one per direction, regardless of the axis. Planes
  /// that the projectile flies against and the two sides of a slice are excluded.
  std::vector<Plane> cuts;
  std::optional<double>
      wall;                ///< axial coordinate of a wall or mirror plane that the projectile flies against
  bool wall_holds = true;  ///< the wall is a mirror plane: material touching it stays there
  std::size_t projectile = 0;  ///< the fastest body
  double impact_speed = 0.0;   ///< relative speed of the fastest and the slowest body, m/s
  double parting_speed = 0.0;  ///< if nothing moves at the start: speed of the fastest body at the end, m/s
  double impact_angle = 0.0;   ///< between their relative velocity and the axis, rad; 0: normal impact
  Vector3 direction = Vector3::Zero();     ///< of the flight: relative velocity over its axial component
  std::array<int, 2> transverse = {0, 1};  ///< upward in pictures; sight, normal to the only mirror plane

  [[nodiscard]] bool is_planar() const { return dimension != grid::Dimension::space; }
  /// Returns the number of models side by side about the axis that make up the full problem: 4 for a quarter model, 1
  /// for a slice.
  [[nodiscard]] double copies() const { return static_cast<double>(1U << (planes.size() - slices)); }
  /// Returns the multiplicity in the full problem of a piece that touches no cut.
  [[nodiscard]] double images() const { return static_cast<double>(1U << cuts.size()); }
  /// Returns this frame about the point at which the line of flight meets an axial coordinate (m).
  [[nodiscard]] Frame at_face(double coordinate) const;
  /// Returns this frame along another axis of the model, with positive axial flight component. The axis must not be
  /// normal to a mirror plane.
  [[nodiscard]] Frame along(int other) const;
  /// Returns the component or coordinate along the flight.
  [[nodiscard]] double axial(const Vector3& v) const { return sign * v[axis]; }
  /// Returns the distance from the axis.
  [[nodiscard]] double radius(const Vector3& position) const;
  /// Returns the axial speed (m/s) above which material is debris (forward) or ejecta (backward).
  [[nodiscard]] double debris_speed() const { return 0.05 * std::max(impact_speed, parting_speed); }
  /// Returns the area of a ring about the axis, m^2; in plane strain that of the strips on both sides.
  [[nodiscard]] double ring_area(double inner, double outer) const;
  /// Returns the velocity component away from the axis; on the axis the magnitude of the transverse velocity.
  [[nodiscard]] double radial_speed(const Vector3& position, const Vector3& velocity) const;
  /// Returns the extent (m) of a particle normal to the plane in two dimensions; in axisymmetry the circumference of
  /// the ring.
  [[nodiscard]] double depth(const Vector3& position) const;
  /// Returns the edge (m) of the square (in three dimensions the cube) filled by a particle of volume `volume` (m^3).
  [[nodiscard]] double edge(double volume, const Vector3& position) const;
  /// Returns whether the model ends at a mirror plane in this direction.
  [[nodiscard]] bool mirrored(int direction) const;
};

/// Determines the frame from the velocities in the input and the position of the projectile in the first snapshot. If
/// nothing moves at the start, the axis is the direction along which the bodies separate up to the last snapshot.
/// @param axis  0, 1 or 2 instead of the detected axis
Frame find_frame(const Run& run, const Snapshot& first, std::optional<int> axis = {},
                 const Snapshot* last = nullptr);

/// Holds the extent of the particles of a body along the axis, including half a particle beyond the centres.
struct Extent {
  double lower = 0.0, upper = 0.0;
  [[nodiscard]] double length() const { return upper - lower; }
};
Extent axial_extent(const Snapshot& snapshot, const Frame& frame, std::size_t body, double spacing);

/// Returns the value below which a fraction of the weight is found; NaN if there is no weight. Sorts its argument.
double weighted_quantile(std::vector<std::pair<double, double>>& value_and_weight, double fraction);

}  // namespace whipple::analysis

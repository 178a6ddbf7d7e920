// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/analysis/frame.hpp"
#include "src/analysis/table.hpp"

/// Tables of the hits on a plane, by distance from the axis and over time.
namespace whipple::analysis {

/// Describes a particle that hits a plane, multiplied by its copies in the full problem.
struct Hit {
  double radius = 0.0;                              ///< distance from the axis, m
  double time = 0.0;                                ///< s
  double mass = 0.0, momentum = 0.0, energy = 0.0;  ///< kg, axial kg m/s, kinetic J
};

/// Creates the hit of a particle that flies through a point at a time.
Hit hit_of(const Frame& frame, const Vector3& place, double time, double mass, const Vector3& velocity);

/// Holds the loads on a plane.
struct Loads {
  Table rings;  ///< mass, momentum and energy in rings about the axis, and per area
  Table flux;   ///< mass, momentum and energy per time
  Quantities totals;
};

/// Sums hits over rings and time intervals.
/// @param name   prefix of the names of tables and totals: "witness", "loads"
/// @param plane  the plane that is hit, for the descriptions of the tables
/// @param ring   width of the rings, m
/// @param times  number of intervals between the first and the last hit
Loads tabulate(const std::vector<Hit>& hits, const Frame& frame, const std::string& name,
               const std::string& plane, double ring, int times);

}  // namespace whipple::analysis

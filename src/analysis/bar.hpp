// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/analysis/frame.hpp"
#include "src/analysis/table.hpp"

/// Measures of bodies along their axis: lengths and diameters, as measured on Taylor bars and residual rods.
namespace whipple::analysis {

/// Computes the diameter of the circle with the cross-sectional area of the body, along the axis.
Table diameter_profile(const Snapshot& snapshot, const Frame& frame, const Run& run);

/// Measures a bar that flies at a wall: its length, its diameters and the state at its impact end. Returns nothing for
/// other bodies.
/// @param diameter_at distance from the wall at which the diameter is measured; 0: not requested
/// @param held        the bar touched a mirror plane from the start, so that no gap can form
Quantities bar_measures(const Snapshot& snapshot, const Frame& frame, std::size_t body,
                        const BodyInput& input, double cell_size, double diameter_at, bool held);

/// Measures the spall of a body in planar impact from the gaps along the axis in the last snapshot.
/// @param planar  the impact is planar; otherwise both values are NaN
Quantities spall_measures(const Snapshot& first, const Snapshot& last, const Frame& frame, std::size_t body,
                          const BodyInput& input, bool planar);

/// Measures the residual rod behind its target along its direction of flight.
Quantities rod_measures(const Snapshot& first, const Snapshot& last, std::size_t body, const BodyInput& input,
                        double cell_size);

/// Returns the drop of a velocity from its maximum to the following minimum (pull-back); NaN if it does not rise again
/// by 1 % of the maximum.
double pullback(const std::vector<double>& velocity);

}  // namespace whipple::analysis

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/analysis/frame.hpp"
#include "src/analysis/table.hpp"

/// Bodies along their axis: lengths and diameters, as measured on Taylor bars and residual rods.
namespace whipple::analysis {

/// Diameter of the circle with the cross-section of the body, along the axis.
Table diameter_profile(const Snapshot& snapshot, const Frame& frame, const Run& run);

/// Measures a bar that flies at a wall: its length, its diameter and the state at its end on the wall. Other bodies
/// have none of these.
/// @param diameter_at distance from the wall at which the diameter is asked for; 0: not
/// @param held        it touched a mirror plane from the start, so that no gap can be between them
Quantities bar_measures(const Snapshot& snapshot, const Frame& frame, std::size_t body,
                        const BodyInput& input, double cell_size, double diameter_at, bool held);

/// Measures the spall of a body in planar impact, from the gaps along the axis at the last snapshot.
/// @param planar  the impact is planar; otherwise both values are NaN
Quantities spall_measures(const Snapshot& first, const Snapshot& last, const Frame& frame, std::size_t body,
                          const BodyInput& input, bool planar);

/// Measures the rest of a rod behind its target, along its direction of flight.
Quantities rod_measures(const Snapshot& first, const Snapshot& last, std::size_t body, const BodyInput& input,
                        double cell_size);

/// Fall of a velocity from its greatest value to the following minimum (pull-back); NaN if it does not rise
/// again by 1 % of the greatest value.
double pullback(const std::vector<double>& velocity);

}  // namespace whipple::analysis

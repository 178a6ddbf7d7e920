// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/case.hpp"

namespace whipple::cases {

/// Returns whether two bodies initially touch or overlap and have the same velocity there, according to the boxes of
/// the whole particles that fill them (or would); bodies closer than a twentieth of a cell touch.
bool touch_and_move_alike(const Case& setup, const Body& a, const Body& b);

/// Returns the distance (m) of the bounding boxes of two bodies that are initially separate and meet before the end of
/// the run if nothing stops them; 0 if they are not separate, or do not meet.
double gap_that_closes(const Case& setup, const Body& a, const Body& b);

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/case.hpp"

namespace whipple::cases {

/// Returns whether two bodies touch or overlap at the start and have the same velocity where they do, by the boxes of
/// the whole particles that fill them, or would; bodies nearer than a twentieth of a cell touch.
bool touch_and_move_alike(const Case& setup, const Body& a, const Body& b);

/// Distance (m) of the bounding boxes of two bodies that are apart at the start and meet before the end of
/// the run if nothing stops them; 0: they are not apart, or do not meet.
double gap_that_closes(const Case& setup, const Body& a, const Body& b);

}  // namespace whipple::cases

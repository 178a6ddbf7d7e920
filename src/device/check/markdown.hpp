// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/device/check/compare.hpp"
#include "src/device/check/timing.hpp"

/// Tables for documents.
namespace whipple::device::check {

std::string comparison_head();
/// Returns the line of a state.
std::string comparison_row(const StoredState& state, const Comparison& found);

/// Returns the times of all arrangements, with a column for each stage that takes time, ns per particle and step; in
/// brackets the roofline of the step.
std::string timing_table(const std::vector<Timing>& timings, const Rates& rates);

}  // namespace whipple::device::check

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "md_fitting/data_set/fluid_points.hpp"
#include "md_fitting/data_set/solid_points.hpp"
#include "md_fitting/data_set/static_points.hpp"

/// Records of the points of all protocols.
namespace whipple::md {

/// Returns whether the crystal of a point did not melt; true for a point without that result.
bool is_solid(const PointRecord& point);

/// Returns whether a result is a flag, of whichever protocol.
bool is_flag(std::string_view result);

/// Returns the table of conditions and results of all protocols as Markdown: the list in
/// docs/theory/molecular_dynamics.md.
std::string describe_points();

}  // namespace whipple::md

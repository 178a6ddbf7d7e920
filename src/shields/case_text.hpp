// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/shields/layout.hpp"
#include "src/shields/shield.hpp"

namespace whipple::shields {

/// Writes the case of an impact. The run ends when the outcome of the wall is decided.
/// @throws InputError if the library has no material for an alloy
std::string case_text(const Impact& impact, const Layout& layout);

/// Writes the study that searches the critical diameter at several speeds, in two cell sizes and three positions of the
/// grid, with the case of `limit_case`.
/// @param speeds  m/s
/// @param between smallest and largest diameter, m
std::string study_text(const Impact& impact, const Layout& layout, const std::vector<double>& speeds,
                       const std::array<double, 2>& between);

/// Lists where a library material differs from its alloy; empty: nowhere.
std::vector<std::string> remarks_on_materials(const Impact& impact, const Layout& layout);

}  // namespace whipple::shields

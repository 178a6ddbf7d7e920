// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace whipple {

/// Rows of cells as lines of equal columns, two blanks between, without blanks at the ends of lines. Rows may
/// have fewer cells than others. Widths count characters of UTF-8, not bytes.
/// @param alignment  one letter per column, 'l' to the left or 'r' to the right; the last one holds for all
/// further columns
std::string text_table(const std::vector<std::vector<std::string>>& rows, std::string_view alignment);

}  // namespace whipple

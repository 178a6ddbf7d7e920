// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace whipple {

/// Formats rows of cells as lines with aligned columns, separated by two blanks, without trailing blanks. Rows may have
/// different numbers of cells. Widths are in UTF-8 characters, not bytes.
/// @param alignment  one letter per column, 'l' for left or 'r' for right; the last one applies to all further columns
std::string text_table(const std::vector<std::vector<std::string>>& rows, std::string_view alignment);

}  // namespace whipple

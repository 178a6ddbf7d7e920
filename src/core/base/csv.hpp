// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Cells of CSV files following RFC 4180, one row per line.
namespace whipple {

/// Returns a text as a cell: quoted if it contains commas or quotes; line ends become spaces.
std::string csv_cell(std::string_view text);

/// Splits a line into its cells, without their quotes. Inverts `csv_cell` for cells joined by commas.
std::vector<std::string> csv_cells(std::string_view line);

}  // namespace whipple

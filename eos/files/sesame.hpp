// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "eos/table/sesame_data.hpp"

/// Files of the SESAME library in their ASCII layout of 80 columns (docs/manual/output.md, section "SESAME files").
namespace whipple::eos {

/// One material of a file; its tables 101, 201, 301 and 401, others are passed over.
/// @param number of the material; nothing: the only one of the file
/// @throws InputError "file:line: what was expected": missing or cut short, a number that is none, counts
/// that contradict each other, an axis that does not rise, no such material, no table 201 or 301
SesameMaterial read_sesame(const std::filesystem::path& path, std::optional<int> number = std::nullopt);

/// Writes a file; it appears under its name when it is complete. Nine significant digits.
/// @throws InputError naming the file: numbers that are not finite, more than 999999 words in a table
void write_sesame(const std::filesystem::path& path, std::span<const SesameMaterial> materials);

}  // namespace whipple::eos

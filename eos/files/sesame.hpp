// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "eos/table/sesame_data.hpp"

/// Reads and writes files of the SESAME library in their ASCII layout of 80 columns (docs/manual/output.md, section
/// "SESAME files").
namespace whipple::eos {

/// Reads one material of a file: its tables 101, 201, 301 and 401; others are skipped.
/// @param number of the material; nothing: the file has only one
/// @throws InputError "file:line: what was expected": missing or truncated, an invalid number, inconsistent counts,
/// an axis that does not increase, no such material, no table 201 or 301
SesameMaterial read_sesame(const std::filesystem::path& path, std::optional<int> number = std::nullopt);

/// Writes a file with nine significant digits; it gets its final name when it is complete.
/// @throws InputError naming the file: numbers that are not finite, more than 999999 words in a table
void write_sesame(const std::filesystem::path& path, std::span<const SesameMaterial> materials);

}  // namespace whipple::eos

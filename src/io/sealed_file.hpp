// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

/// Implements a seal (checksum) of a whole file in its first bytes (the user block of HDF5, which every HDF5 tool
/// skips): magic word, format version, size and digest as text. HDF5 1.10 is not safe with corrupted or malicious
/// files, so only files with an intact seal are opened with it.
namespace whipple::io {

/// Defines the size of the seal at the beginning of the file, in bytes.
constexpr std::uint64_t seal_size = 512;
/// Defines the format version of checkpoints; a reader rejects newer ones.
constexpr int checkpoint_format = 2;

/// Writes the seal of a complete file into its first bytes.
/// @throws InputError naming the file
void seal(const std::filesystem::path& path);

/// Checks the seal of a file.
/// @throws InputError naming the file and the fault: not sealed, of a newer format, truncated, damaged
void require_seal(const std::filesystem::path& path);

/// Forces the contents of the file to disk, so that they survive a power failure.
/// @throws InputError naming the file
void force_to_disk(const std::filesystem::path& path);

}  // namespace whipple::io

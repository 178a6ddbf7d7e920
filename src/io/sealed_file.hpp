// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

/// A seal over a whole file, kept in its first bytes (the user block of HDF5, which every HDF5 tool skips):
/// magic word, format version, size and digest as text. HDF5 1.10 was not made for hostile files, so nothing
/// but a file with an intact seal is handed to it.
namespace whipple::io {

/// Bytes at the beginning of the file that belong to the seal.
constexpr std::uint64_t seal_size = 512;
/// Format of checkpoints; a reader refuses newer ones.
constexpr int checkpoint_format = 2;

/// Writes the seal of a complete file into its first bytes. @throws InputError naming the file
void seal(const std::filesystem::path& path);

/// @throws InputError naming the file and what is wrong: not sealed, of a newer format, truncated, damaged
void require_seal(const std::filesystem::path& path);

/// A power failure after this leaves the content of the file. @throws InputError naming the file
void force_to_disk(const std::filesystem::path& path);

}  // namespace whipple::io

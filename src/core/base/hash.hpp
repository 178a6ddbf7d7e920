// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace whipple {

/// Returns the SHA-256 hash of bytes as 64 hexadecimal digits (FIPS PUB 180-4, section 6.2).
std::string sha256(std::string_view bytes);

/// Returns the SHA-256 hash of the content of a file.
/// @throws InputError if the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// Converts the leading digits of a hash to a seed for the random generators of LAMMPS: 1 ... 899999999.
std::int64_t seed_from(std::string_view hexadecimal);

}  // namespace whipple

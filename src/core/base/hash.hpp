// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace whipple {

/// SHA-256 of the bytes as 64 hexadecimal digits (FIPS PUB 180-4, section 6.2).
std::string sha256(std::string_view bytes);

/// SHA-256 of a file's content.
/// @throws InputError if the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// The leading digits of a hash as a seed for LAMMPS' generators: 1 ... 899999999.
std::int64_t seed_from(std::string_view hexadecimal);

}  // namespace whipple

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace whipple::md {

/// Rewrites a database with its points ordered by protocol, conditions and key, in a file without traces of its
/// history: the same points give the same bytes, regardless of who computed them, in which order and with which
/// interruptions. The old file remains until the new one is complete.
/// @throws InputError if the database cannot be read or written
void normalise_store(const std::filesystem::path& path);

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace whipple::md {

/// Rewrites a store with its points in the order of protocol, conditions and key, in a file without the
/// traces of its history: the same points give the same bytes, whoever computed them in which order,
/// interrupted or not. The old file stands until the new one is complete.
/// @throws InputError if the store cannot be read or written
void normalise_store(const std::filesystem::path& path);

}  // namespace whipple::md

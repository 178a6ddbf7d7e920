// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace whipple {

/// Nothing is overwritten unless asked for. An empty path (no file wanted) passes.
/// @throws InputError if the file exists and `force` is not set
void require_new_file(const std::filesystem::path& path, bool force);

/// The same for a figure, whose ending must be one that it can be drawn as: png, pdf, svg.
void require_new_figure(const std::filesystem::path& path, bool force);

}  // namespace whipple

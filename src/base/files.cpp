// SPDX-License-Identifier: BSD-3-Clause
#include "src/base/files.hpp"

#include <fmt/format.h>

#include "src/base/error.hpp"

namespace whipple {

void require_new_file(const std::filesystem::path& path, bool force) {
  if (!path.empty() && std::filesystem::exists(path) && !force) {
    throw InputError(fmt::format("'{}' exists; --force overwrites it", path.string()));
  }
}

void require_new_figure(const std::filesystem::path& path, bool force) {
  const std::string ending = path.extension().string();
  if (!path.empty() && ending != ".png" && ending != ".pdf" && ending != ".svg") {
    throw InputError(fmt::format("'{}': a figure ends in .png, .pdf or .svg", path.string()));
  }
  require_new_file(path, force);
}

}  // namespace whipple

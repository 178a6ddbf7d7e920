// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/paths.hpp"

#include <fmt/format.h>

#include "src/app/build_info.hpp"
#include "src/base/error.hpp"

namespace whipple::app {

std::filesystem::path own_executable() { return std::filesystem::read_symlink("/proc/self/exe"); }

std::filesystem::path find_executable(const std::string& name) {
  std::filesystem::path path = own_executable().parent_path() / name;
  if (!std::filesystem::exists(path)) {
    throw InputError(
        fmt::format("the executable '{}' is missing (expected at {}): build all targets of the project", name,
                    path.string()));
  }
  return path;
}

std::filesystem::path find_data(const std::filesystem::path& relative) {
  std::filesystem::path installed = own_executable().parent_path().parent_path() / "share/whipple" / relative;
  if (std::filesystem::exists(installed)) return installed;
  std::filesystem::path in_source = std::filesystem::path(build_info().source_folder) / relative;
  if (std::filesystem::exists(in_source)) return in_source;
  throw InputError(fmt::format("'{}' is missing: neither {} nor {} exists", relative.string(),
                               installed.string(), in_source.string()));
}

}  // namespace whipple::app

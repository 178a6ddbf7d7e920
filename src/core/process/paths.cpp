// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/process/paths.hpp"

#include <fmt/format.h>

#include "src/core/base/error.hpp"

namespace whipple::process {

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
  std::filesystem::path in_source = std::filesystem::path(WHIPPLE_SOURCE_FOLDER) / relative;
  if (std::filesystem::exists(in_source)) return in_source;
  throw InputError(fmt::format("'{}' is missing: neither {} nor {} exists", relative.string(),
                               installed.string(), in_source.string()));
}

std::filesystem::path find_experiment(const std::string& name) {
  std::filesystem::path path(name);
  if (std::filesystem::exists(path)) return path;
  if (!path.has_parent_path()) {
    std::filesystem::path file = path;
    if (!file.has_extension()) file += ".csv";
    try {
      return find_data(std::filesystem::path("eos/data") / file);
    } catch (const InputError&) {
      // Reported below, with the folders as the user wrote them.
    }
  }
  throw InputError(
      fmt::format("no experiment '{}': neither a file nor one of the data that come with the program "
                  "(eos/data)",
                  name));
}

}  // namespace whipple::process

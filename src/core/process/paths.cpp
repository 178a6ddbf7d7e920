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

namespace {

struct Locations {
  std::filesystem::path installed, in_source;
};

Locations locations(const std::filesystem::path& relative) {
  return {.installed = own_executable().parent_path().parent_path() / "share/whipple" / relative,
          .in_source = std::filesystem::path(WHIPPLE_SOURCE_FOLDER) / relative};
}

}  // namespace

std::optional<std::filesystem::path> data_if_there(const std::filesystem::path& relative) {
  const auto [installed, in_source] = locations(relative);
  if (std::filesystem::exists(installed)) return installed;
  if (std::filesystem::exists(in_source)) return in_source;
  return std::nullopt;
}

std::filesystem::path find_data(const std::filesystem::path& relative) {
  if (const auto found = data_if_there(relative)) return *found;
  const auto [installed, in_source] = locations(relative);
  throw InputError(fmt::format("'{}' is missing: neither {} nor {} exists", relative.string(),
                               installed.string(), in_source.string()));
}

std::filesystem::path find_experiment(const std::string& name) {
  std::filesystem::path path(name);
  if (std::filesystem::exists(path)) return path;
  if (!path.has_parent_path()) {
    std::filesystem::path file = path;
    if (!file.has_extension()) file += ".csv";
    if (const auto found = data_if_there(std::filesystem::path("eos/data") / file)) return *found;
  }
  throw InputError(
      fmt::format("no experiment '{}': neither a file nor one of the data that come with the program "
                  "(eos/data)",
                  name));
}

}  // namespace whipple::process

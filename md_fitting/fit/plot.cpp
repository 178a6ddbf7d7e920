// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/plot.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "src/base/error.hpp"

namespace whipple::fit {
namespace {

std::filesystem::path find_script(const std::string& name) {
  std::filesystem::path installed =
      std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "share/whipple/scripts" /
      name;
  if (std::filesystem::exists(installed)) return installed;
  std::filesystem::path in_source = std::filesystem::path(WHIPPLE_SCRIPTS_FOLDER) / name;
  if (std::filesystem::exists(in_source)) return in_source;
  throw InputError(fmt::format("the script '{}' is missing: neither {} nor {} exists", name,
                               installed.string(), in_source.string()));
}

std::string python() {
  if (const char* variable = std::getenv("WHIPPLE_PYTHON")) return variable;
  return std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
}

}  // namespace

void draw(const std::string& script, const std::string& data, const std::filesystem::path& figure) {
  std::filesystem::path data_file = figure;
  data_file += ".json.part";
  {
    std::ofstream file(data_file);
    file << data;
    if (!file.flush()) throw InputError(fmt::format("cannot write '{}'", data_file.string()));
  }
  std::array<std::string, 4> words = {python(), find_script(script).string(), data_file.string(),
                                      figure.string()};
  std::array<char*, 5> arguments = {words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                                    nullptr};
  pid_t pid = 0;
  const int fault = posix_spawnp(&pid, arguments[0], nullptr, nullptr, arguments.data(), environ);
  int status = 0;
  if (fault == 0) {
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
  }
  std::filesystem::remove(data_file);
  if (fault != 0) throw InputError(fmt::format("cannot start '{}': {}", words[0], std::strerror(fault)));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw InputError(
        fmt::format("{} failed (it needs python3 with numpy and matplotlib; WHIPPLE_PYTHON names "
                    "another interpreter)",
                    words[1]));
  }
}

}  // namespace whipple::fit

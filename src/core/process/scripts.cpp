// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/process/scripts.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/process/paths.hpp"
#include "src/core/process/process.hpp"

namespace whipple::process {

int run_script(const std::string& script, const std::vector<std::string>& arguments) {
  const char* variable = std::getenv("WHIPPLE_PYTHON");
  const std::string debian = "/usr/bin/python3";
  const std::string python = variable != nullptr               ? variable
                             : std::filesystem::exists(debian) ? debian
                                                               : "python3";
  // -E: a PYTHONPATH of the user, or modules in a visited folder, must not shadow numpy.
  std::vector<std::string> command = {python, "-E", find_data(script).string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_process(command, {{"WHIPPLE_PROGRAM", (own_executable().parent_path() / "whipple").string()}});
}

void draw_with(const std::string& script, const std::vector<std::string>& arguments) {
  if (run_script(script, arguments) != 0) {
    throw InputError(fmt::format(
        "{} failed (it needs python3 with numpy and matplotlib; WHIPPLE_PYTHON names another interpreter)",
        script));
  }
}

void draw_json(const std::string& script, const std::string& json, const std::filesystem::path& figure) {
  const PartialFile data(figure);  // never published
  write_text_atomically(data.path(), json);
  draw_with(script, {data.path().string(), figure.string()});
}

}  // namespace whipple::process

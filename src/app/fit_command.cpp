// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/fit_command.hpp"

#include <string>
#include <vector>

#include "src/core/process/paths.hpp"
#include "src/core/process/process.hpp"

namespace whipple::app {

void add_fit_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "fit", "Fit the constants of an equation of state to a store of molecular-dynamics results");
  // All arguments, including --help, are passed on to whipple-fit.
  command->set_help_flag();
  command->allow_extras();
  command->prefix_command();
  command->callback([command] {
    std::vector<std::string> arguments = {process::find_executable("whipple-fit").string()};
    const std::vector<std::string> passed = command->remaining();
    arguments.insert(arguments.end(), passed.begin(), passed.end());
    const int code = process::run_process(arguments);
    if (code != 0) throw CLI::RuntimeError(code);
  });
}

}  // namespace whipple::app

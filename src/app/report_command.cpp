// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/report_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "src/app/paths.hpp"
#include "src/app/process.hpp"
#include "src/base/error.hpp"
#include "src/base/log.hpp"

namespace whipple::app {
namespace {

int run_report(const std::string& run_directory) {
  if (!std::filesystem::is_directory(run_directory)) {
    throw InputError(
        fmt::format("{}: error: is not a folder; expected the output of whipple run", run_directory));
  }
  // Debian's interpreter, not the first of PATH: numpy, h5py and matplotlib are Debian's packages.
  std::vector<std::string> arguments = {"/usr/bin/python3", find_data("scripts/report.py").string(),
                                        run_directory};
  if (log::level() == log::Level::quiet) arguments.emplace_back("--quiet");
  return run_process(arguments);
}

}  // namespace

void add_report_command(CLI::App& app) {
  auto run_directory = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("report", "Figures and tables of a run, as one HTML page");
  command->add_option("run", *run_directory, "The run directory")->required();
  command->footer("Example:\n  whipple report run/copper_disk_on_aluminium");
  command->callback([run_directory] {
    const int code = run_report(*run_directory);
    if (code != 0) throw CLI::RuntimeError(code);
  });
}

}  // namespace whipple::app

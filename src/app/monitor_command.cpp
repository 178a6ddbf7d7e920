// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/monitor_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/process/paths.hpp"
#include "src/core/process/process.hpp"
#include "src/monitor/handler.hpp"
#include "src/monitor/server.hpp"
#include "src/run/status.hpp"

namespace whipple::app {
namespace {

namespace fs = std::filesystem;

struct MonitorOptions {
  std::string folder = "run", cases;
  std::uint16_t port = 0;
  int minutes = 0;
  bool read_only = false;
};

void monitor_runs(const MonitorOptions& options) {
  const fs::path cases = options.cases.empty() ? process::find_data("cases") : fs::path(options.cases);
  require_folder(options.folder);
  require_folder(cases);
  monitor::Folder folder(options.folder);
  monitor::Server server(options.port);
  const monitor::Access access{
      .host = server.host(), .token = monitor::random_token(), .read_only = options.read_only};
  const auto start = [output = folder.output_of_started()](const std::vector<std::string>& arguments) {
    std::vector<std::string> program = {process::own_executable().string(), "run"};
    program.insert(program.end(), arguments.begin(), arguments.end());
    process::start_in_background(program, output);
  };
  monitor::Handler handler(std::move(folder), access, process::find_data("web/monitor"),
                           process::find_data("web/viewer"), cases, start);
  // The key is in the fragment of the URL (after #), which browsers do not send.
  fmt::print("Open http://{}/#{} in a browser of this machine; Ctrl-C ends the monitor, not the runs.\n",
             access.host, access.token);
  std::fflush(stdout);
  server.serve(handler, std::chrono::minutes(options.minutes),
               [&options] { return !run::any_goes_on(options.folder); });
}

}  // namespace

void add_monitor_command(CLI::App& app) {
  auto options = std::make_shared<MonitorOptions>();
  CLI::App* command = app.add_subcommand("monitor", "Watch, steer and start runs in the browser");
  command->add_option("dir", options->folder,
                      "A run directory, or a folder with some at any depth (default: run)");
  command->add_option("--port", options->port, "Port of 127.0.0.1 (default: one that is free)")
      ->check(CLI::Range(1024, 65535));
  command->add_flag("--read-only", options->read_only, "Show only: no requests, no starts");
  command
      ->add_option("--cases", options->cases,
                   "Folder of cases that can be started (default: those of whipple)")
      ->type_name("FOLDER");
  command
      ->add_option("--idle", options->minutes,
                   "End when no page has asked for so many minutes and no run goes on (default: never)")
      ->type_name("MINUTES")
      ->check(CLI::Range(1, 100000));
  command->footer(
      "Example:\n  whipple monitor run\n"
      "Only browsers of this machine can reach it, and only with the key in the printed address. From "
      "another one:\n"
      "  ssh -L 8123:127.0.0.1:8123 HOST, there whipple monitor run --port 8123");
  command->callback([options] { monitor_runs(*options); });
}

}  // namespace whipple::app

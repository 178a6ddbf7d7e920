// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/steer_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/text_table.hpp"
#include "src/run/directory_control.hpp"
#include "src/run/requests.hpp"
#include "src/run/status.hpp"

namespace whipple::app {
namespace {

namespace fs = std::filesystem;

/// Holds the status of a run, or the reason why it cannot be read.
struct Found {
  fs::path run;
  std::optional<run::RunStatus> status;
  std::string fault;
};

std::vector<Found> statuses_below(const fs::path& folder) {
  std::vector<Found> found;
  for (const fs::path& path : run::find_runs(folder)) {
    Found& next = found.emplace_back(path);
    try {
      next.status = run::read_status(path);
    } catch (const InputError& error) {
      next.fault = error.what();
    }
  }
  if (found.empty()) throw InputError(fmt::format("{}: contains no run with a status.json", folder.string()));
  return found;
}

/// Prints the states of runs as one list, each with its folder; folder names and messages need not be UTF-8.
void print_as_json(const std::vector<Found>& runs) {
  using nlohmann::json;
  json list = json::array();
  for (const Found& found : runs) {
    json entry = found.status ? run::status_json(*found.status)
                              : json{{"state", "unknown"}, {"goes_on", false}, {"time", nullptr},
                                     {"step", nullptr},    {"end", nullptr},   {"message", found.fault}};
    entry["run"] = found.run.string();
    list.push_back(std::move(entry));
  }
  fmt::print("{}\n", json_text(list, 1));
}

void print_as_table(const std::vector<Found>& runs) {
  std::vector<std::vector<std::string>> rows = {
      {"run", "state", "done", "step", "t [us]", "end [us]", "left", "message"}};
  for (const Found& found : runs) {
    if (!found.status) {
      rows.push_back({found.run.string(), "unknown", "", "", "", "", "", "its status cannot be read"});
      continue;
    }
    const run::RunStatus& s = *found.status;
    rows.push_back({found.run.string(), std::string(word_of(s.state)),
                    fmt::format("{:.1f} %", s.end > 0.0 ? 100.0 * s.time / s.end : 0.0),
                    fmt::format("{}", s.step), fmt::format("{:.4g}", 1e6 * s.time),
                    fmt::format("{:.4g}", 1e6 * s.end),
                    run::goes_on(s.state) && s.time_left ? format_duration(*s.time_left) : "",
                    s.message.substr(0, s.message.find('\n'))});
  }
  fmt::print("{}", text_table(rows, "llrrrrrl"));
}

/// Prints the states of the runs in a folder.
/// @throws InputError after all runs were printed, if the status of one cannot be read
void print_status(const fs::path& folder, bool json) {
  const std::vector<Found> runs = statuses_below(folder);
  json ? print_as_json(runs) : print_as_table(runs);
  std::string faults;
  for (const Found& found : runs) {
    if (!found.status) faults += (faults.empty() ? "" : "\n") + found.fault;
  }
  if (!faults.empty()) throw InputError(faults);
}

}  // namespace

void add_steer_command(CLI::App& app) {
  struct Arguments {
    std::string run, request, value;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("steer", "Send a request to a running simulation");
  command->add_option("run", arguments->run, "The run directory")->required();
  command->add_option("request", arguments->request, "What is asked")->required();
  command->add_option("value", arguments->value, "The new value, with its unit");
  command->footer("Requests:\n" + run::describe_acts() +
                  "The answer is printed, and kept in steering.csv of the run directory.\n"
                  "Example:\n  whipple steer run/disk snapshot\n  whipple steer run/disk end '5 us'");
  command->callback([arguments] {
    constexpr std::chrono::seconds patience(20);
    const std::optional<run::Answer> answer =
        run::steer(arguments->run, arguments->request, arguments->value, patience);
    if (!answer) {
      fmt::print("no answer yet: a step may last long; it will be in steering.csv\n");
    } else if (answer->verdict == run::Verdict::refused) {
      throw InputError(fmt::format("{}: refused: {}", arguments->run, answer->detail));
    } else {
      fmt::print("accepted{}{}\n", answer->detail.empty() ? "" : ", ", answer->detail);
    }
  });
}

void add_status_command(CLI::App& app) {
  auto folder = std::make_shared<std::string>("run");
  CLI::App* command = app.add_subcommand("status", "How far runs are");
  command->add_option("dir", *folder, "A run directory, or a folder with some at any depth (default: run)");
  command->footer("Example:\n  whipple status run/disk");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "The same as a list for programs");
  command->callback([folder, json] { print_status(*folder, *json); });
}

}  // namespace whipple::app

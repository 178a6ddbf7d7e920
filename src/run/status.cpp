// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/io/run_directory.hpp"

namespace whipple::run {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

void write_status(const std::filesystem::path& file, const RunStatus& status) {
  const Json json = {{"state", word_of(status.state)},
                     {"time", status.time},
                     {"step", status.step},
                     {"time_step", status.time_step},
                     {"end", status.end},
                     {"wall_time", status.wall_time},
                     {"time_left", status.time_left ? Json(*status.time_left) : Json(nullptr)},
                     {"revision", status.revision},
                     {"message", status.message},
                     {"written", status.written},
                     {"ended_by", status.ended_by}};
  // Messages may quote files of any encoding.
  io::write_text_atomically(file, json_text(json, 2) + "\n");
}

RunStatus read_status(const std::filesystem::path& run) {
  const std::filesystem::path file = run / "status.json";
  RunStatus status;
  try {
    const Json json = parse_ordered_json(read_text(file));
    const auto word = json.at("state").get<std::string>();
    const std::optional<Activity> state = value_of<Activity>(word);
    if (!state) throw InputError(fmt::format("{}: unknown state \"{}\" of a run", file.string(), word));
    status.state = *state;
    json.at("time").get_to(status.time);
    json.at("step").get_to(status.step);
    json.at("time_step").get_to(status.time_step);
    json.at("end").get_to(status.end);
    json.at("wall_time").get_to(status.wall_time);
    if (!json.at("time_left").is_null()) status.time_left = json.at("time_left").get<double>();
    json.at("revision").get_to(status.revision);
    json.at("message").get_to(status.message);
    json.at("written").get_to(status.written);
    status.ended_by = json.value("ended_by", "");  // runs of earlier versions have none
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: is no status of a run: {}", file.string(), error.what()));
  }
  if (goes_on(status.state) && !io::is_running(run)) status.state = Activity::lost;
  return status;
}

nlohmann::json status_json(const RunStatus& status) {
  using nlohmann::json;
  const auto number = [](double value) { return std::isfinite(value) ? json(value) : json(nullptr); };
  return {{"state", word_of(status.state)},
          {"goes_on", goes_on(status.state)},
          {"time", number(status.time)},
          {"step", status.step},
          {"time_step", number(status.time_step)},
          {"end", number(status.end)},
          {"wall_time", number(status.wall_time)},
          {"time_left", status.time_left ? number(*status.time_left) : json(nullptr)},
          {"revision", status.revision},
          {"message", status.message},
          {"written", status.written},
          {"ended_by", status.ended_by}};
}

std::vector<std::filesystem::path> find_runs(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  require_folder(folder);
  const auto is_run = [](const fs::path& path) {
    std::error_code hidden;  // unreadable folders are skipped
    return fs::exists(path / "status.json", hidden);
  };
  if (is_run(folder)) return {folder};
  std::vector<fs::path> runs;
  std::error_code changed;  // a folder may be removed during the search
  constexpr auto passing = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(folder, passing, changed), last; entry != last;
       entry.increment(changed)) {
    if (changed) break;
    if (!entry->is_directory(changed) || !is_run(entry->path())) continue;
    runs.push_back(entry->path());
    entry.disable_recursion_pending();
  }
  std::ranges::sort(runs);
  return runs;
}

bool any_goes_on(const std::filesystem::path& folder) {
  return std::ranges::any_of(find_runs(folder), [](const std::filesystem::path& run) {
    try {
      return goes_on(read_status(run).state);
    } catch (const InputError&) {
      return false;
    }
  });
}

}  // namespace whipple::run

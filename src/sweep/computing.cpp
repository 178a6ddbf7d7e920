// SPDX-License-Identifier: BSD-3-Clause
#include "src/sweep/computing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/machine.hpp"
#include "src/core/base/text.hpp"
#include "src/core/process/paths.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/status.hpp"

namespace whipple::sweep {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double usable_memory = 0.8;  // of the machine; the rest is of the system and of other programs
constexpr int was_stopped = 124;       // this exit code and higher ones: the run can go on

/// Returns the status of the run of a point; nothing if it has none.
std::optional<run::RunStatus> status_of(const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder / "status.json", none)) return std::nullopt;
  try {
    return run::read_status(folder);
  } catch (const InputError&) {  // a damaged file: the run starts over
    return std::nullopt;
  }
}

/// Removes snapshots and checkpoints of a finished run.
void remove_large_files(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder / "checkpoint", ignored);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && (name.ends_with(".hdf") || name.ends_with(".hdf.series")))
      files.push_back(entry);
  }
  for (const fs::path& file : files) fs::remove(file, ignored);
}

}  // namespace

Computer::Computer(const Plan& plan, fs::path folder, process::Pool& pool, Options options)
    : plan_(plan),
      folder_(std::move(folder)),
      program_(process::own_executable()),
      pool_(pool),
      options_(options) {
  const std::vector<Wanted> wanted = plan.study.wanted();
  measures_ = wanted.empty() || !std::ranges::all_of(wanted, &Wanted::is_column);
  const Computing& study = plan.study.computing;
  const int cores = usable_processors();
  const auto by_cores = std::max<std::int64_t>(1, cores / study.threads);
  const double memory = usable_memory * physical_memory();
  const auto by_memory = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::min(1e6, memory / std::max(plan.most_memory, 1.0))));
  const std::int64_t asked = study.jobs == 0 ? by_cores : study.jobs;
  const std::int64_t jobs = std::min({asked, by_cores, by_memory});
  if (jobs < asked) {
    log::warning("{} points side by side instead of {}: {} cores for {} thread{} each, {} for {} each", jobs,
                 asked, cores, study.threads, study.threads == 1 ? "" : "s", format_bytes(memory),
                 format_bytes(plan.most_memory));
  }
  jobs_ = static_cast<std::size_t>(jobs);
}

fs::path Computer::record_file(const Point& point) const {
  return folder_ / "points" / (point.name() + ".json");
}
fs::path Computer::log_file(const Point& point) const { return folder_ / "points" / (point.name() + ".log"); }

Record Computer::record(const Point& point) const {
  const fs::path file = record_file(point);
  std::error_code none;
  if (!fs::exists(file, none)) return {};
  try {
    const Json json = parse_ordered_json(read_text(file));
    const std::optional<State> state = value_of<State>(json.at("state").get<std::string>());
    if (!state || json.at("digest") != point.digest) throw InputError("not of this point");
    return {*state, json.at("exit_code"), json.at("message"), json.at("wall_time")};
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("{}: error: is no record of a point ({}): remove it to compute the point again",
                    file.string(), error.what()));
  }
}

void Computer::finish(const Point& point, Record record) {
  Json changes = Json::object();
  for (std::size_t v = 0; v < plan_.variables.size(); ++v) changes[plan_.variables[v].name] = point.texts[v];
  const Json json = {{"digest", point.digest},         {"values", changes},
                     {"cell_size", point.cell_size},   {"offset", point.offset},
                     {"state", word_of(record.state)}, {"exit_code", record.exit_code},
                     {"message", record.message},      {"wall_time", record.wall_time}};
  if (plan_.study.computing.keep == Keep::tables) remove_large_files(run_folder(point));
  replace_durably(record_file(point), record_file(point).string() + ".partial", json_text(json, 2) + "\n");
  std::error_code ignored;
  if (record.state == State::done) fs::remove(log_file(point), ignored);
  ++computed_;
}

std::string Computer::last_words(const Point& point) const {
  std::string text;
  try {
    text = read_text(log_file(point));
  } catch (const InputError&) {
    return {};
  }
  while (text.ends_with('\n')) text.pop_back();
  constexpr std::size_t most = 2000;
  return text.size() > most ? text.substr(text.size() - most) : text;
}

/// Starts the program of a task. @returns false if another process still holds the run
bool Computer::start(std::size_t tag, Task& task) {
  const fs::path run = run_folder(*task.point);
  if (fs::exists(run) && io::is_running(run)) return false;
  const std::optional<run::RunStatus> status = status_of(run);
  if (task.stage == Stage::run && status && status->state == run::Activity::done) task.stage = Stage::analyse;
  std::vector<std::string> program = {program_.string()};
  const std::string threads = std::to_string(plan_.study.computing.threads);
  if (task.stage == Stage::analyse) {
    program.insert(program.end(), {"analyse", run.string(), "--quiet"});
    program.insert(program.end(), plan_.study.computing.analyse.begin(), plan_.study.computing.analyse.end());
  } else if (!io::list_checkpoints(run / "checkpoint").empty() && status &&
             status->state != run::Activity::failed) {
    program.insert(program.end(), {"run", "--restart", run.string(), "--threads", threads, "--quiet"});
  } else {
    program.insert(program.end(),
                   {"run", plan_.base.file.string(), "-o", run.string(), "--threads", threads, "--quiet"});
    if (fs::exists(run)) program.emplace_back("--force");
    make_folder(folder_ / "materials");
    for (const auto& [key, value] : changes_in(*task.point, folder_ / "materials"))
      program.insert(program.end(), {"--set", key + "=" + value});
  }
  pool_.start(tag, program, log_file(*task.point));
  return true;
}

bool Computer::ended(Task& task, int code) {
  const Point& point = *task.point;
  if (code >= was_stopped) {  // goes on when the study is started again
    if (pool_.stopped_by() == 0)
      log::warning("{} was stopped from outside: {}", run_folder(point).string(), last_words(point));
    return false;
  }
  const std::optional<run::RunStatus> status = status_of(run_folder(point));
  const double seconds = status ? status->wall_time : 0.0;
  if (task.stage == Stage::analyse) {
    finish(point, code == 0 ? Record{State::done, 0, status ? status->ended_by : "", seconds}
                            : Record{State::failed, code, "measures: " + last_words(point), seconds});
    return false;
  }
  if (code != 0) {
    const bool tells = status && status->state == run::Activity::failed;
    finish(point, {State::failed, code, tells ? status->message : last_words(point), seconds});
    return false;
  }
  if (measures_) {
    task.stage = Stage::analyse;
    return true;
  }
  finish(point, {State::done, 0, status ? status->ended_by : "", seconds});
  return false;
}

bool Computer::compute(std::span<const Point> points) {
  make_folder(folder_ / "points");
  std::deque<Task> waiting;
  std::size_t failed = 0;
  std::map<std::string, int> taken;
  for (const Point& point : points) {
    const State state = record(point).state;
    if (state == State::done || (state == State::failed && !options_.retry)) continue;
    if (taken[point.digest]++ == 0) waiting.push_back({&point, Stage::run});
  }
  const std::size_t total = waiting.size();
  if (total < points.size() && total > 0)
    log::info("{} of {} points are finished: {} to compute", points.size() - total, points.size(), total);
  std::vector<Task> under_way;
  std::vector<bool> free;
  std::size_t finished = 0;
  bool told = false;
  while ((!waiting.empty() || pool_.running() > 0)) {
    while (!waiting.empty() && pool_.running() < jobs_ && pool_.stopped_by() == 0) {
      Task task = waiting.front();
      waiting.pop_front();
      const auto slot = static_cast<std::size_t>(std::ranges::find(free, true) - free.begin());
      if (slot == free.size()) {
        free.push_back(true);
        under_way.push_back(task);
      }
      if (!start(slot, task)) {
        if (!told)
          log::info("{} is held by another process: waiting for it", run_folder(*task.point).string());
        told = true;
        waiting.push_back(task);
        break;
      }
      free[slot] = false;
      under_way[slot] = task;
    }
    if (pool_.stopped_by() != 0 && pool_.running() == 0) return false;
    const std::optional<process::Pool::Ended> end = pool_.wait();
    if (!end) continue;
    Task& task = under_way[end->tag];
    if (ended(task, end->code) && pool_.stopped_by() == 0) {
      if (start(end->tag, task)) continue;
      waiting.push_front(task);
    }
    free[end->tag] = true;
    const Record result = record(*task.point);
    if (result.state == State::missing) continue;
    ++finished;
    failed += result.state == State::failed ? 1 : 0;
    log::info(
        "{}/{}{}: {}{}", finished, total, failed > 0 ? fmt::format(", {} failed", failed) : "",
        fmt::join(task.point->texts, ", "),
        result.state == State::failed ? ": " + result.message.substr(0, result.message.find('\n')) : "");
  }
  return pool_.stopped_by() == 0;
}

}  // namespace whipple::sweep

// SPDX-License-Identifier: BSD-3-Clause
#include "src/sweep/computing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <deque>
#include <nlohmann/json.hpp>
#include <set>
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
/// Exit codes of a run that was asked to end, or had reached its limit of wall time: it can go on.
constexpr std::array was_stopped = {124, 128 + SIGHUP, 128 + SIGINT, 128 + SIGKILL, 128 + SIGTERM};
/// Exit codes of the shell and the dynamic linker for a program that they could not start.
constexpr std::array not_started = {126, 127};

/// Names a signal by which a program that is at fault ends; all others come from outside.
struct Crash {
  int signal;
  const char* name;
};
constexpr std::array crashes = {Crash{SIGSEGV, "SIGSEGV"}, Crash{SIGABRT, "SIGABRT"},
                                Crash{SIGBUS, "SIGBUS"},   Crash{SIGFPE, "SIGFPE"},
                                Crash{SIGILL, "SIGILL"},   Crash{SIGSYS, "SIGSYS"}};

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
    Record record = {*state, json.at("exit_code"), json.at("message"), json.at("wall_time"), {}};
    const auto measured = json.find("measured");  // records of earlier versions tell nothing: measured again
    if (measured != json.end() && !measured->is_null())
      record.measured = measured->get<std::vector<std::string>>();
    return record;
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("{}: error: is no record of a point ({}): remove it to compute the point again",
                    file.string(), error.what()));
  }
}

void Computer::finish(const Point& point, Record record) {
  Json changes = Json::object();
  for (std::size_t v = 0; v < plan_.variables.size(); ++v) changes[plan_.variables[v].name] = point.texts[v];
  const Json json = {{"digest", point.digest},
                     {"values", changes},
                     {"cell_size", point.cell_size},
                     {"offset", point.offset},
                     {"state", word_of(record.state)},
                     {"exit_code", record.exit_code},
                     {"message", record.message},
                     {"wall_time", record.wall_time},
                     {"measured", record.measured ? Json(*record.measured) : Json(nullptr)}};
  if (plan_.study.computing.keep == Keep::tables) remove_large_files(run_folder(point));
  replace_durably(record_file(point), record_file(point).string() + ".partial", json_text(json, 2) + "\n");
  std::error_code ignored;
  if (record.state == State::done) fs::remove(log_file(point), ignored);
  unmeasured_.erase(point.name());
  locks_.erase(point.name());
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

std::string Computer::unmeasured(const Point& point) const {
  const auto found = unmeasured_.find(point.name());
  return found == unmeasured_.end() ? "" : found->second;
}

/// Tells from which program on a point is to be computed.
Computer::Need Computer::need_of(const Record& record) const {
  switch (record.state) {
    case State::missing:
      return Need::run;
    case State::failed: {
      const bool in_other_measures = record.measured && !(measures_ && is_measured(record));
      return options_.retry || in_other_measures ? Need::run : Need::nothing;
    }
    case State::done:
      break;
  }
  return measures_ && !is_measured(record) ? Need::measures : Need::nothing;
}

/// Starts the program of a task, or finishes its point if the run is all that it needs.
Computer::Start Computer::start(std::size_t tag, Task& task) {
  const Point& point = *task.point;
  const fs::path run = run_folder(point);
  std::unique_ptr<const FileLock>& lock = locks_[point.name()];
  if (!lock) {
    const fs::path file = folder_ / "points" / (point.name() + ".lock");
    lock = FileLock::if_free(file, fmt::format("the point {}", run.string()));
    if (!lock) {
      elsewhere_.push_back({point.name(), FileLock::last_holder(file)});
      locks_.erase(point.name());
      return Start::is_elsewhere;
    }
    task.need = need_of(record(point));  // the former holder may have finished it
  }
  if (task.need == Need::nothing) {
    locks_.erase(point.name());
    return Start::finished;
  }
  if (fs::exists(run) && io::is_running(run)) {
    locks_.erase(point.name());
    return Start::run_is_held;
  }
  const std::optional<run::RunStatus> status = status_of(run);
  if (task.need == Need::run && status && status->state == run::Activity::done) {
    task.need = Need::measures;
    if (!measures_) {
      finish(point, {State::done, 0, status->ended_by, status->wall_time, {}});
      return Start::finished;
    }
  }
  const std::vector<std::string>& options = plan_.study.computing.analyse;
  std::vector<std::string> program = {program_.string(), "analyse", run.string(), "--quiet"};
  program.insert(program.end(), options.begin(), options.end());
  pool_.start(tag, task.need == Need::run ? run_program(point, status) : program, log_file(point));
  return Start::running;
}

/// Returns the command that computes the run of a point, from its checkpoint if it has one.
std::vector<std::string> Computer::run_program(const Point& point,
                                               const std::optional<run::RunStatus>& status) const {
  const fs::path run = run_folder(point);
  const std::string threads = std::to_string(plan_.study.computing.threads);
  if (!io::list_checkpoints(run / "checkpoint").empty() && status && status->state != run::Activity::failed)
    return {program_.string(), "run", "--restart", run.string(), "--threads", threads, "--quiet"};
  std::vector<std::string> program = {
      program_.string(), "run",    plan_.base.file.string(), "-o", run.string(), "--threads",
      threads,           "--quiet"};
  if (fs::exists(run)) program.emplace_back("--force");
  make_folder(folder_ / "materials");
  for (const auto& [key, value] : changes_in(point, folder_ / "materials"))
    program.insert(program.end(), {"--set", key + "=" + value});
  return program;
}

/// Stores what the end of a program says about a point.
Computer::End Computer::ended(const Task& task, const process::Pool::Ended& end) {
  const Point& point = *task.point;
  const auto crash = std::ranges::find(crashes, end.signal, &Crash::signal);
  const bool crashed = end.signal != 0 && crash != crashes.end();
  if (end.signal == 0 && std::ranges::count(not_started, end.code) > 0)
    throw InputError(fmt::format("{} could not be started: {}", program_.string(), last_words(point)));
  if (!crashed && (end.signal != 0 || std::ranges::count(was_stopped, end.code) > 0)) {
    if (pool_.stopped_by() == 0)
      log::warning("{} was stopped from outside: {}", run_folder(point).string(), last_words(point));
    return End::unfinished;  // goes on when the study is started again
  }
  const std::string last = last_words(point);
  const std::string words =
      crashed ? fmt::format("crashed by {}{}{}", crash->name, last.empty() ? "" : ": ", last) : last;
  if (task.need == Need::measures) return measured(point, words, end.code);
  const std::optional<run::RunStatus> status = status_of(run_folder(point));
  const double seconds = status ? status->wall_time : 0.0;
  ++computed_;
  if (end.code != 0) {
    const bool tells = status && status->state == run::Activity::failed;
    finish(point, {State::failed, end.code, tells ? status->message : words, seconds, {}});
    return End::finished;
  }
  if (measures_) return End::needs_measures;
  finish(point, {State::done, 0, status ? status->ended_by : "", seconds, {}});
  return End::finished;
}

/// Stores the result of an analysis. Where it fails, a point that was finished before remains so.
Computer::End Computer::measured(const Point& point, const std::string& fault, int code) {
  if (code != 0 && record(point).state == State::done) {
    unmeasured_[point.name()] = fault;
    log::warning(
        "{} cannot be measured with the options of the study, its run remains: {}\n  to compute it again, "
        "remove "
        "the folder and {}",
        run_folder(point).string(), fault, record_file(point).string());
    return End::finished;
  }
  const std::optional<run::RunStatus> status = status_of(run_folder(point));
  const double seconds = status ? status->wall_time : 0.0;
  const std::vector<std::string>& options = plan_.study.computing.analyse;
  if (code != 0) {
    finish(point, {State::failed, code, "measures: " + fault, seconds, options});
  } else {
    finish(point, {State::done, 0, status ? status->ended_by : "", seconds, options});
  }
  return End::finished;
}

void Computer::tell(const Point& point, std::size_t finished, std::size_t total) const {
  const Record result = record(point);
  log::info("{}/{}{}: {}{}", finished, total, failed_ > 0 ? fmt::format(", {} failed", failed_) : "",
            fmt::join(point.texts, ", "),
            result.state == State::failed ? ": " + result.message.substr(0, result.message.find('\n')) : "");
}

bool Computer::compute(std::span<const Point> points) {
  make_folder(folder_ / "points");
  std::deque<Task> waiting;
  std::set<std::string> taken;
  std::size_t to_measure = 0;
  for (const Point& point : points) {
    const Need need = need_of(record(point));
    if (need == Need::nothing || !taken.insert(point.digest).second) continue;
    waiting.push_back({&point, need});
    to_measure += need == Need::measures ? 1 : 0;
  }
  const std::size_t total = waiting.size();
  if (total < points.size() && total > to_measure)
    log::info("{} of {} points are finished: {} to compute", points.size() - total + to_measure,
              points.size(), total - to_measure);
  if (to_measure > 0) log::info("{} finished points are measured with other options than before", to_measure);
  std::map<std::size_t, Task> under_way;
  std::size_t tag = 0, finished = 0;
  failed_ = 0;
  bool told = false;
  const auto is_finished = [&](const Point& point) {
    failed_ += record(point).state == State::failed ? 1 : 0;
    tell(point, ++finished, total);
  };
  while (!waiting.empty() || pool_.running() > 0) {
    while (!waiting.empty() && pool_.running() < jobs_ && pool_.stopped_by() == 0) {
      Task task = waiting.front();
      waiting.pop_front();
      const Start begun = start(++tag, task);
      if (begun == Start::running) under_way.insert_or_assign(tag, task);
      if (begun == Start::finished) is_finished(*task.point);
      if (begun != Start::run_is_held) continue;
      if (!told) log::info("{} is held by another process: waiting for it", run_folder(*task.point).string());
      told = true;
      waiting.push_back(task);
      break;
    }
    if (pool_.stopped_by() != 0 && pool_.running() == 0) return false;
    const std::optional<process::Pool::Ended> end = pool_.wait();
    if (!end) continue;
    Task task = under_way.extract(end->tag).mapped();
    const End how = ended(task, *end);
    if (how == End::needs_measures) {
      waiting.push_front({task.point, Need::measures});
      continue;
    }
    locks_.erase(task.point->name());
    if (how == End::finished) is_finished(*task.point);
  }
  return pool_.stopped_by() == 0;
}

}  // namespace whipple::sweep

// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/directory_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <sstream>
#include <system_error>
#include <thread>
#include <vector>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/run/observer.hpp"

namespace whipple::run {
namespace {

namespace fs = std::filesystem;

/// Explains why a request cannot be executed in the present state of a run; empty if it can.
std::string obstacle(const Request& request, const Moment& moment) {
  if (request.act == Act::pause && moment.paused) return "the run is paused already";
  if (request.act == Act::resume && !moment.paused) return "the run is not paused";
  if (request.act == Act::end && request.value > 0.0 && request.value < moment.time()) {
    return fmt::format("the run is at t = {} s already; without a value it ends now", moment.time());
  }
  return "";
}

/// Returns the former value that a request replaces, with its unit; empty if it replaces none.
std::string replaced_by(const Request& request, const Schedule& schedule) {
  const ActEntry& entry = entry_of(request.act);
  return entry.changes == nullptr ? "" : fmt::format("was {}", number_of(entry, schedule));
}

/// Finds the answer to the request of a file in the table; returns nothing if there is none.
std::optional<Answer> find_answer(const fs::path& table, const std::string& file) {
  std::istringstream rows(fs::exists(table) ? read_text(table) : std::string());
  std::optional<Answer> found;
  for (std::string line; std::getline(rows, line);) {
    const std::vector<std::string> cells = csv_cells(line);
    if (cells.size() != 7 || cells[2] != file) continue;
    if (const std::optional<Verdict> verdict = value_of<Verdict>(cells[5]))
      found = Answer{*verdict, cells[6]};
  }
  return found;
}

}  // namespace

DirectoryControl::DirectoryControl(const io::RunDirectory& directory, std::chrono::duration<double> interval)
    : folder_(directory.control_folder()), table_(directory.steering_file()), interval_(interval) {
  std::error_code fault;
  fs::create_directory(folder_, fault);
  if (fault)
    throw InputError(fmt::format("{}: cannot make the folder: {}", folder_.string(), fault.message()));
}

void DirectoryControl::look() {
  const Clock::time_point now = Clock::now();
  if (now < next_look_) return;
  next_look_ = now + std::chrono::duration_cast<Clock::duration>(interval_);
  std::error_code ignored;  // a removed folder contains no requests
  for (fs::directory_iterator entry(folder_, ignored), last; entry != last; entry.increment(ignored)) {
    if (entry->path().extension() == ".toml" && entry->is_regular_file(ignored))
      waiting_.push_back(entry->path());
  }
  std::ranges::sort(waiting_);
}

void DirectoryControl::ask(const Moment& moment, Requests& requests) {
  if (waiting_.empty()) look();
  if (waiting_.empty() || requests.steering.act != Act::none) return;
  const fs::path file = waiting_.front();
  waiting_.pop_front();
  requests.steering = take(file, moment);
}

void DirectoryControl::end(const Moment& moment) {
  waiting_.clear();
  next_look_ = {};
  look();
  for (const fs::path& file : waiting_) take(file, moment, "the run has ended");
  waiting_.clear();
}

Request DirectoryControl::take(const fs::path& file, const Moment& moment, const std::string& too_late) {
  const fs::path taken = file.string() + ".taken";  // no second execution if the run is killed now
  std::error_code fault;
  fs::rename(file, taken, fault);
  if (fault) return {};  // it was withdrawn
  RequestWords words;
  Request request;
  std::string reason;
  try {
    words = read_request(taken);
    request = parse_request(words.request, words.value);
    reason = too_late.empty() ? obstacle(request, moment) : too_late;
  } catch (const std::exception& error) {  // an invalid file must not end the run
    reason = error.what();
  }
  if (!reason.empty()) request = {};
  const bool accepted = reason.empty();
  write(moment, file.filename().string(), words,
        accepted ? Answer{Verdict::accepted, replaced_by(request, moment.schedule)}
                 : Answer{Verdict::refused, reason});
  fs::remove(taken, fault);
  return request;
}

void DirectoryControl::write(const Moment& moment, const std::string& file, const RequestWords& words,
                             const Answer& answer) const {
  std::error_code ignored;
  const bool is_new = !fs::exists(table_, ignored);
  try {
    append_text(table_, fmt::format("{}{},{},{},{},{},{},{}\n", is_new ? std::string(header) + "\n" : "",
                                    moment.time(), moment.step(), csv_cell(file), csv_cell(words.request),
                                    csv_cell(words.value), word_of(answer.verdict), csv_cell(answer.detail)));
  } catch (const InputError& error) {  // the run continues
    log::warning("{}", error.what());
  }
  log::info("request {}{}{}: {}{}{}", words.request, words.value.empty() ? "" : " ", words.value,
            word_of(answer.verdict), answer.detail.empty() ? "" : ", ", answer.detail);
}

std::optional<Answer> steer(const fs::path& run, const std::string& word, const std::string& value,
                            std::chrono::duration<double> patience) {
  (void)parse_request(word, value);
  const fs::path folder = run / "control";
  if (!fs::is_regular_file(run / "run.toml"))
    throw InputError(fmt::format("{}: is not the folder of a run: it contains no run.toml", run.string()));
  if (!io::is_running(run) || !fs::is_directory(folder))
    throw InputError(fmt::format("{}: no run is active there that could follow a request", run.string()));
  // File names sort in the order of time.
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const fs::path file = folder / fmt::format("{}.toml", std::chrono::nanoseconds(now).count()),
                 table = run / "steering.csv";
  std::error_code missing;
  io::write_text_atomically(file, request_toml(word, value));

  const auto is_waiting = [&] {
    return fs::exists(file, missing) || fs::exists(file.string() + ".taken", missing);
  };
  constexpr auto pause = std::chrono::milliseconds(50);
  for (const auto begin = std::chrono::steady_clock::now(); is_waiting();) {
    if (std::chrono::steady_clock::now() - begin >= patience) return std::nullopt;
    if (!io::is_running(run)) {  // it was killed, or it last read the folder before the file existed
      if (!fs::remove(file, missing)) break;
      throw InputError(fmt::format("{}: the run ended before it followed the request", run.string()));
    }
    std::this_thread::sleep_for(pause);
  }
  return find_answer(table, file.filename().string());
}

}  // namespace whipple::run

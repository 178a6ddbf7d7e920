// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/directory_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <optional>
#include <system_error>
#include <thread>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/io/history.hpp"
#include "src/run/observer.hpp"

namespace whipple::run {
namespace {

namespace fs = std::filesystem;

/// Explains why a request cannot be followed in the present state of a run; empty if it can.
std::string obstacle(const Request& request, const Moment& moment) {
  if (request.act == Act::pause && moment.paused) return "the run is paused already";
  if (request.act == Act::resume && !moment.paused) return "the run is not paused";
  if (request.act == Act::end && request.value > 0.0 && request.value < moment.time()) {
    return fmt::format("the run is at t = {} s already; without a value it ends now", moment.time());
  }
  return "";
}

/// Says what a request does, with the number that it replaces.
std::string result_of(const Request& request, const Schedule& schedule) {
  const ActEntry& entry = entry_of(request.act);
  return entry.changes == nullptr ? "accepted" : fmt::format("accepted, was {}", number_of(entry, schedule));
}

}  // namespace

DirectoryControl::DirectoryControl(const io::RunDirectory& directory, std::chrono::duration<double> interval)
    : folder_(directory.control_folder()), table_(directory.steering_file()), interval_(interval) {
  std::error_code fault;
  fs::create_directory(folder_, fault);
  if (fault) throw InputError(fmt::format("{}: cannot make the folder: {}", folder_.string(), fault.message()));
}

void DirectoryControl::look() {
  const Clock::time_point now = Clock::now();
  if (now < next_look_) return;
  next_look_ = now + std::chrono::duration_cast<Clock::duration>(interval_);
  std::error_code ignored;  // whoever removes the folder asks for nothing
  for (fs::directory_iterator entry(folder_, ignored), last; entry != last; entry.increment(ignored)) {
    if (entry->path().extension() == ".toml" && entry->is_regular_file(ignored)) waiting_.push_back(entry->path());
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

Request DirectoryControl::take(const fs::path& file, const Moment& moment) {
  const fs::path taken = file.string() + ".taken";  // a run that is killed now does not follow it twice
  std::error_code fault;
  fs::rename(file, taken, fault);
  if (fault) return {};  // it has been withdrawn
  RequestWords words;
  Request request;
  std::string result;
  try {
    words = read_request(taken);
    request = parse_request(words.request, words.value);
    result = obstacle(request, moment);
    if (result.empty()) {
      answer(moment, words, result_of(request, moment.schedule));
    }
  } catch (const std::exception& error) {  // whatever is in the file, the run goes on
    result = error.what();
  }
  fs::remove(taken, fault);
  if (result.empty()) return request;
  answer(moment, words, "refused: " + result);
  return {};
}

void DirectoryControl::answer(const Moment& moment, const RequestWords& words, const std::string& result) const {
  std::error_code ignored;
  const bool is_new = !fs::exists(table_, ignored);
  std::ofstream table(table_, std::ios::app | std::ios::binary);
  if (is_new) table << "time [s],step,request,value,result\n";
  table << fmt::format("{},{},{},{},{}\n", moment.time(), moment.step(), io::csv_cell(words.request),
                       io::csv_cell(words.value), io::csv_cell(result));
  table.flush();
  if (!table) log::warning("{}: cannot write the line; is the disk full?", table_.string());  // the run goes on
  log::info("request {}{}{}: {}", words.request, words.value.empty() ? "" : " ", words.value, result);
}

std::string steer(const fs::path& run, const std::string& word, const std::string& value,
                  std::chrono::duration<double> patience) {
  (void)parse_request(word, value);
  const fs::path folder = run / "control";
  if (!fs::is_regular_file(run / "run.toml"))
    throw InputError(fmt::format("{}: is not the folder of a run: it holds no run.toml", run.string()));
  if (!io::is_running(run) || !fs::is_directory(folder))
    throw InputError(fmt::format("{}: no run goes on there that could follow a request", run.string()));
  // Names in the order of time.
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const fs::path file = folder / fmt::format("{}.toml", std::chrono::nanoseconds(now).count()),
                 table = run / "steering.csv";
  std::error_code missing;
  const std::uintmax_t former = fs::exists(table) ? fs::file_size(table, missing) : 0;
  io::write_text_atomically(file, request_toml(word, value));

  const auto is_waiting = [&] { return fs::exists(file, missing) || fs::exists(file.string() + ".taken", missing); };
  constexpr auto pause = std::chrono::milliseconds(50);
  for (const auto begin = std::chrono::steady_clock::now(); is_waiting();) {
    if (std::chrono::steady_clock::now() - begin >= patience) return "";
    std::this_thread::sleep_for(pause);
  }
  std::ifstream answers(table, std::ios::binary);
  answers.seekg(static_cast<std::streamoff>(former));
  const std::string own = fmt::format(",{},{},", io::csv_cell(word), io::csv_cell(value));
  for (std::string line; std::getline(answers, line);) {
    if (const std::size_t at = line.find(own); at != std::string::npos) return line.substr(at + own.size());
  }
  return "";
}

}  // namespace whipple::run

// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/observers/status_file.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <optional>

#include "src/core/base/error.hpp"
#include "src/core/base/last_message.hpp"
#include "src/core/base/log.hpp"

namespace whipple::run {
namespace {

constexpr std::chrono::seconds interval{1};

Activity state_of(Outcome::Kind kind) {
  switch (kind) {
    case Outcome::Kind::done:
      return Activity::done;
    case Outcome::Kind::stopped:
      return Activity::stopped;
    case Outcome::Kind::left_range:
    case Outcome::Kind::out_of_resources:
      break;
  }
  return Activity::failed;
}

}  // namespace

void StatusFile::start(const Moment& moment) {
  first_time_ = moment.time();
  write(moment, Activity::running, log::last_message());
}

void StatusFile::after_step(const Moment& moment) {
  if (!ranks_.is_root()) return;
  const Activity state = moment.paused ? Activity::paused : Activity::running;
  if (state != written_ || Clock::now() - written_at_ >= interval) write(moment, state, log::last_message());
}

void StatusFile::end(const Moment& moment, Outcome& outcome) {
  write(moment, state_of(outcome.kind), outcome.message.empty() ? log::last_message() : outcome.message);
}

void StatusFile::write(const Moment& moment, Activity state, const std::string& message) {
  if (!ranks_.is_root()) return;
  const double done = moment.time() - first_time_, left = moment.schedule.end - moment.time();
  const cases::Case& setup = moment.simulation.setup();
  const int condition = moment.requests.condition;
  written_ = state;
  written_at_ = Clock::now();
  try {
    write_status(
        file_,
        {.state = state,
         .time = moment.time(),
         .step = moment.step(),
         .time_step = moment.simulation.state().time_step,
         .end = moment.schedule.end,
         .wall_time = moment.wall_time,
         .time_left = done > 0.0 ? std::optional(moment.wall_time * left / done) : std::nullopt,
         .revision = program_,
         .message = message,
         .written = fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr))),
         .ended_by = condition > 0 ? setup.stops[static_cast<std::size_t>(condition - 1)].in_words() : ""});
  } catch (const InputError& error) {  // the results are not affected, and the other ranks are not informed
    log::warning("{}", error.what());
  }
}

}  // namespace whipple::run

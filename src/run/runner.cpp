// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <new>
#include <thread>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/resource_error.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::run {
namespace {

constexpr int out_of_time_code = 124;  // as in timeout(1)
constexpr std::chrono::milliseconds look_of_pause{50};

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Combines the requests of all ranks, because signals may reach them in different steps and clocks differ.
Requests agree(MPI_Comm communicator, const Requests& own) {
  std::array<double, 6> numbers = {
      static_cast<double>(own.signal),
      own.out_of_time ? 1.0 : 0.0,
      own.checkpoint ? 1.0 : 0.0,
      static_cast<double>(own.steering.act),
      own.steering.value,
      static_cast<double>(own.condition)};  // at least 0, the value of ranks without requests
  parallel::maximum(communicator, numbers);
  return {.signal = static_cast<int>(numbers[0]),
          .out_of_time = numbers[1] > 0.0,
          .checkpoint = numbers[2] > 0.0,
          .steering = {static_cast<Act>(numbers[3]), numbers[4]},
          .condition = static_cast<int>(numbers[5])};
}

}  // namespace

Runner::Runner(solver::Simulation& simulation, Observers observers, double wall_time)
    : simulation_(simulation),
      observers_(std::move(observers)),
      wall_time_(wall_time),
      schedule_(simulation.setup()) {}

void Runner::begin() {
  for (const auto& observer : observers_) observer->begin(now());
}

void Runner::resume(const io::CheckpointValues& values, int ended_by) {
  requests_.condition = ended_by;
  if (ended_by > 0) schedule_.end = simulation_.state().time;
  for (const auto& observer : observers_) observer->resume(now(), values);
}

int Runner::run(std::span<RunControl* const> controls) {
  controls_ = controls;
  begin_ = last_checkpoint_ = Clock::now();
  try {
    steps();
    Outcome result = outcome();
    for (const auto& observer : observers_) observer->end(now(), result);
    for (RunControl* control : controls_) control->end(now());
    return result.exit_code;
  } catch (const StateError& error) {
    throw StateError(failed({Outcome::Kind::left_range, static_cast<int>(ExitCode::state), error.what()}));
  } catch (const InputError& error) {  // the input was read: this is an output file that cannot be written
    throw out_of_resources(error.what());
  } catch (const ResourceError& error) {
    throw out_of_resources(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw out_of_resources(error.what());
  } catch (const std::bad_alloc&) {
    throw out_of_resources("the memory that this process may use is exhausted");
  }
}

ResourceError Runner::out_of_resources(const std::string& reason) {
  return ResourceError(failed({Outcome::Kind::out_of_resources, static_cast<int>(ExitCode::state), reason}));
}

void Runner::steps() {
  while (!has_ended()) {
    simulation_.advance(next_stop());
    at_border();
    while (paused_ && !has_ended()) {
      std::this_thread::sleep_for(look_of_pause);
      at_border();
    }
  }
}

void Runner::at_border() {
  requests_ = agree(simulation_.communicator(), asked());
  for (RunControl* control : controls_) control->writing_begins();
  follow(requests_.steering);
  if (requests_.condition > 0) schedule_.end = simulation_.state().time;
  for (const auto& observer : observers_) observer->after_step(now());
  if (requests_.checkpoint) last_checkpoint_ = Clock::now();
  if (has_ended()) return;
  for (RunControl* control : controls_) control->step_begins();
}

/// Collects the requests of the controls and of the clock of this rank.
Requests Runner::asked() {
  Requests own;
  for (RunControl* control : controls_) control->ask(now(), own);
  for (const auto& observer : observers_) observer->ask(now(), own);
  const double every = schedule_.checkpoint_every;
  own.checkpoint = own.checkpoint || own.steering.act == Act::checkpoint ||
                   (every > 0.0 && seconds_since(last_checkpoint_) >= every);
  own.out_of_time = own.out_of_time || (wall_time_ > 0.0 && seconds_since(begin_) >= wall_time_);
  return own;
}

void Runner::follow(const Request& request) {
  if (request.act == Act::none) return;
  if (request.act == Act::pause || request.act == Act::resume) paused_ = request.act == Act::pause;
  // Steps end at snapshots: an interval much smaller than a step would shorten every step and fill the disk.
  constexpr double least_part_of_step = 1e-3;
  if (const double least = least_part_of_step * simulation_.state().unclipped_step;
      request.act == Act::snapshot_every && request.value > 0.0 && request.value < least) {
    log::warning("snapshots every {:.3g} s are refused: at least {:.3g} s, a thousandth of a time step",
                 request.value, least);
    return;
  }
  double Schedule::* const number = entry_of(request.act).changes;
  if (number != nullptr) schedule_.*number = request.value;
  if (request.act == Act::end) schedule_.end = std::max(request.value, simulation_.state().time);
}

Moment Runner::now() const {
  return {simulation_, schedule_, requests_, observers_, seconds_since(begin_), paused_};
}

/// Returns the time (s) at which the current step must end at the latest.
double Runner::next_stop() const {
  double stop = schedule_.end;
  for (const auto& observer : observers_) stop = std::min(stop, observer->next_time());
  // A multiple of an interval may equal the end except for round-off: no step is made for the difference.
  constexpr double round_off = 1e-9;
  return stop < (1.0 - round_off) * schedule_.end ? stop : schedule_.end;
}

bool Runner::has_ended() const { return now().is_last() || requests_.stop(); }

Outcome Runner::outcome() const {
  if (requests_.condition > 0) {
    const auto entry = static_cast<std::size_t>(requests_.condition - 1);
    return {Outcome::Kind::done, 0, "ended because " + simulation_.setup().stops.at(entry).in_words()};
  }
  if (now().is_last()) return {};
  if (requests_.signal != 0) {
    return {Outcome::Kind::stopped, 128 + requests_.signal,
            fmt::format("stopped by signal {}", requests_.signal)};
  }
  if (requests_.out_of_time)
    return {Outcome::Kind::stopped, out_of_time_code, "stopped by the limit of wall time"};
  return {Outcome::Kind::stopped, 128 + SIGTERM, "stopped on request"};
}

/// Notifies the observers of a failure.
/// @returns the message for the user
std::string Runner::failed(Outcome outcome) {
  for (RunControl* control : controls_) control->writing_begins();
  if (outcome.kind == Outcome::Kind::out_of_resources) {
    outcome.message += fmt::format("\n  stopped at step {}, t = {:.6g} s", now().step(), now().time());
  }
  for (const auto& observer : observers_) {
    try {
      observer->end(now(), outcome);
    } catch (const std::exception& fault) {  // must not hide the original error
      outcome.message += fmt::format("\n  {}", fault.what());
    }
  }
  for (RunControl* control : controls_) control->end(now());
  return outcome.message;
}

}  // namespace whipple::run

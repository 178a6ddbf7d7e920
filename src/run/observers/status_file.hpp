// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "src/io/ranks.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/observer.hpp"
#include "src/run/status.hpp"

namespace whipple::run {

/// Updates status.json: the progress of a run and whether it continues (docs/manual/output.md). The file is written at
/// most once per second, and whenever the state changes.
class StatusFile : public RunObserver {
 public:
  /// @param program  name, version and revision
  StatusFile(const io::RunDirectory& directory, std::string program, const io::Ranks& ranks)
      : file_(directory.status_file()), program_(std::move(program)), ranks_(ranks) {}

  void begin(const Moment& moment) override { start(moment); }
  void resume(const Moment& moment, const io::CheckpointValues&) override { start(moment); }
  void after_step(const Moment& moment) override;
  void end(const Moment& moment, Outcome& outcome) override;

 private:
  void start(const Moment& moment);
  void write(const Moment& moment, Activity state, const std::string& message);

  using Clock = std::chrono::steady_clock;
  std::filesystem::path file_;
  std::string program_;
  io::Ranks ranks_;
  double first_time_ = 0.0;          // s, simulated time at the start of this process
  std::optional<Activity> written_;  // state
  Clock::time_point written_at_;
};

}  // namespace whipple::run

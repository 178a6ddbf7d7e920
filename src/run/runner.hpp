// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <span>
#include <string>

#include "src/core/base/resource_error.hpp"
#include "src/run/observer.hpp"

namespace whipple::run {

/// Implements the loop of a run: steps, requests between them, observers after them. All calls are collective.
class Runner {
 public:
  /// @param simulation  must outlive this object
  /// @param wall_time   s, after which the run stops; 0: no limit
  Runner(solver::Simulation& simulation, Observers observers, double wall_time = 0.0);

  /// Calls the observers in the initial state.
  void begin();
  /// Calls the observers in the state of a checkpoint.
  /// @param ended_by  condition of the case, from 1, that had ended the run: no step is made; 0: none
  void resume(const io::CheckpointValues& values, int ended_by = 0);

  /// Advances to the end of the schedule, until a condition of the case holds, or until a control requests
  /// the end.
  /// @returns 0; 128 + number of the signal that stopped the run; 124 at the limit of wall time
  /// @throws StateError    if the physics left its range
  /// @throws ResourceError if disk or memory is insufficient
  int run(std::span<RunControl* const> controls);

 private:
  using Clock = std::chrono::steady_clock;

  void steps();
  void at_border();
  [[nodiscard]] Requests asked();
  void follow(const Request& request);
  [[nodiscard]] Moment now() const;
  [[nodiscard]] double next_stop() const;
  [[nodiscard]] bool has_ended() const;
  [[nodiscard]] Outcome outcome() const;
  [[nodiscard]] std::string failed(Outcome outcome);
  /// Notifies the observers that the run cannot continue.
  /// @returns the exception to throw
  [[nodiscard]] ResourceError out_of_resources(const std::string& reason);

  solver::Simulation& simulation_;
  Observers observers_;
  double wall_time_;
  Schedule schedule_;
  std::span<RunControl* const> controls_;
  Requests requests_;
  bool paused_ = false;
  Clock::time_point begin_ = Clock::now(), last_checkpoint_ = begin_;
};

}  // namespace whipple::run

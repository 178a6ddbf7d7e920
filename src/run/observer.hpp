// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "src/io/checkpoint.hpp"
#include "src/run/control.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {

class RunObserver;
using Observers = std::vector<std::unique_ptr<RunObserver>>;

/// Describes a run between two steps, for its observers; identical on all ranks except for the clock.
struct Moment {
  const solver::Simulation& simulation;
  const Schedule& schedule;
  const Requests& requests;    ///< agreed by all ranks
  const Observers& observers;  ///< all of the run
  double wall_time;            ///< s, since the loop began
  bool paused;

  [[nodiscard]] double time() const { return simulation.state().time; }
  [[nodiscard]] std::int64_t step() const { return simulation.state().step; }
  /// Returns whether the run has reached its end time.
  [[nodiscard]] bool is_last() const { return time() >= schedule.end; }
  /// Returns whether the number of steps is a multiple of `every`.
  [[nodiscard]] bool is_due(double every) const { return step() % static_cast<std::int64_t>(every) == 0; }
  /// Returns whether a request has this action.
  [[nodiscard]] bool asks_for(Act act) const { return requests.steering.act == act; }
};

/// Describes how a run ended.
struct Outcome {
  enum class Kind : std::uint8_t {
    done,
    stopped,          ///< before the end time, by a signal or the limit of wall time
    left_range,       ///< of the physics
    out_of_resources  ///< disk or memory
  };
  Kind kind = Kind::done;
  int exit_code = 0;
  std::string message;  ///< empty if the run reached its end time; observers may add messages for the user
};

/// Observes a run and writes outputs. Observers are called in the order of their list, on all ranks, and may
/// communicate. A run calls `begin` or `resume` once, then `after_step`, then `end`.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  /// Starts observing a new run in its initial state.
  virtual void begin(const Moment&) {}
  /// Continues a run from a checkpoint.
  /// @throws InputError if required data are missing in the checkpoint
  virtual void resume(const Moment&, const io::CheckpointValues&) {}
  /// Processes the state after a step. While a run is paused it is called repeatedly at the same step.
  virtual void after_step(const Moment&) {}
  /// Adds requests of its own to those that all ranks agree on after the next step. Called without communication.
  virtual void ask(const Moment&, Requests&) const {}
  /// Returns the next time (s) after the current one at which a step must end; infinite: any. Identical on all ranks.
  [[nodiscard]] virtual double next_time() const { return std::numeric_limits<double>::infinity(); }
  /// Adds the data that `resume` needs to a checkpoint, and ensures that all output that they count is on disk.
  virtual void remember(io::CheckpointValues&) {}
  /// Finishes at the end of the run. After out_of_resources, ranks must not communicate here.
  virtual void end(const Moment&, Outcome&) {}
};

}  // namespace whipple::run

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

/// A run as its observers see it between two steps; the same on all ranks but for the clock.
struct Moment {
  const solver::Simulation& simulation;
  const Schedule& schedule;
  const Requests& requests;    ///< agreed by all ranks
  const Observers& observers;  ///< all of the run
  double wall_time;            ///< s, since the loop began
  bool paused;

  [[nodiscard]] double time() const { return simulation.state().time; }
  [[nodiscard]] std::int64_t step() const { return simulation.state().step; }
  /// Returns whether the run has come to its end.
  [[nodiscard]] bool is_last() const { return time() >= schedule.end; }
  /// Returns whether steps have been made that are a multiple of `every`.
  [[nodiscard]] bool is_due(double every) const { return step() % static_cast<std::int64_t>(every) == 0; }
  /// Returns whether something is asked that the schedule or the outputs follow.
  [[nodiscard]] bool asks_for(Act act) const { return requests.steering.act == act; }
};

/// How a run ended.
struct Outcome {
  enum class Kind : std::uint8_t {
    done,
    stopped,          ///< before its time, by a signal or the limit of wall time
    left_range,       ///< of the physics
    out_of_resources  ///< disk or memory
  };
  Kind kind = Kind::done;
  int exit_code = 0;
  std::string message;  ///< empty if it is done; observers may add what the user is to be told
};

/// Sees a run and writes something of it. Observers are called in the order of their list, on all ranks, and
/// may communicate. A run calls `begin` or `resume` once, then `after_step`, then `end`.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  /// Begins with a new run, at its first state.
  virtual void begin(const Moment&) {}
  /// Goes on with a run from a checkpoint. @throws InputError if it does not hold what is needed
  virtual void resume(const Moment&, const io::CheckpointValues&) {}
  /// Follows a step. While a run is paused it is called again and again at the same step.
  virtual void after_step(const Moment&) {}
  /// Returns the next time (s) at which a step is to end, after that of now; infinite: any. The same on all ranks.
  [[nodiscard]] virtual double next_time() const { return std::numeric_limits<double>::infinity(); }
  /// Adds to a checkpoint what `resume` needs, and makes sure that what this counts is on disk.
  virtual void remember(io::CheckpointValues&) {}
  /// Ends with the run. Of runs out of resources ranks must not communicate here.
  virtual void end(const Moment&, Outcome&) {}
};

}  // namespace whipple::run

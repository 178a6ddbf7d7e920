// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <optional>

#include "src/core/base/progress.hpp"
#include "src/io/ranks.hpp"
#include "src/run/observer.hpp"

namespace whipple::run {

/// Shows the progress of a run on standard error.
class ProgressBar : public RunObserver {
 public:
  explicit ProgressBar(const io::Ranks& ranks) : ranks_(ranks) {}

  void begin(const Moment& moment) override { start(moment); }
  void resume(const Moment& moment, const io::CheckpointValues&) override { start(moment); }
  void after_step(const Moment& moment) override {
    if (!bar_) return;
    if (moment.schedule.end != end_) start(moment);
    const solver::RunState& state = moment.simulation.state();
    bar_->update(
        state.time,
        fmt::format("step {}, t = {:.3f} us, dt = {:.2f} ns, {} particles, dE/E = {:.1e}{}", state.step,
                    1e6 * state.time, 1e9 * state.time_step, moment.simulation.particle_count(),
                    state.ledger.energy_error(moment.simulation.totals()), moment.paused ? ", paused" : ""));
  }
  /// Ends the line before other output is written.
  void end(const Moment&, Outcome&) override { bar_.reset(); }

 private:
  void start(const Moment& moment) {
    if (!ranks_.is_root()) return;
    end_ = moment.schedule.end;
    bar_.emplace("run", end_);
    bar_->start_from(moment.time());
  }

  io::Ranks ranks_;
  double end_ = 0.0;             // s, end time of the bar
  std::optional<Progress> bar_;  // on the root
};

}  // namespace whipple::run

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "src/analysis/outcome.hpp"
#include "src/analysis/wall.hpp"
#include "src/io/ranks.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/observer.hpp"
#include "src/run/observers/history_columns.hpp"
#include "src/run/observers/snapshots.hpp"

namespace whipple::run {

/// Ends a run where a condition of its case holds ([[stop]]), one step after it was found: speeds, energies and columns
/// are looked at every tenth step, perforation and outcomes in each snapshot, by the measures of `whipple analyse`.
class StopConditions : public RunObserver {
 public:
  /// @param snapshots  of the run, called before this observer; must outlive it
  /// @param setup  names columns of history.csv (`require_known_columns`)
  StopConditions(const cases::Case& setup, const io::RunDirectory& directory, Snapshots& snapshots,
                 const io::Ranks& ranks);

  void begin(const Moment& moment) override { look(moment); }
  void resume(const Moment& moment, const io::CheckpointValues& values) override;
  void after_step(const Moment& moment) override;
  void ask(const Moment& moment, Requests& requests) const override;
  void remember(io::CheckpointValues& values) override;

  /// Returns the condition of a case, from 1, by which the run had ended when a checkpoint was written; 0 if it had not, or
  /// if the case no longer has this condition.
  [[nodiscard]] static int ended_by(const cases::Case& setup, const io::CheckpointValues& values);

 private:
  /// Holds what a condition has seen.
  struct Seen {
    bool was_above = false;             // of speed_below and energy_below
    double largest = 0.0;               // magnitude of the column so far
    std::vector<double> times, values;  // of the column, in the last `over`
    std::optional<HistoryColumn> column;
  };
  /// Holds the motion of a body, summed over the ranks.
  struct Motion {
    double mass = 0.0, energy = 0.0;
    Vector3 momentum = Vector3::Zero();
  };

  void look(const Moment& moment);
  void look_at_sums(const Moment& moment);
  [[nodiscard]] bool holds(const cases::Stop& stop, Seen& seen, const Moment& moment);
  [[nodiscard]] bool has_settled(const cases::Stop& stop, Seen& seen, double time, double value) const;
  void begin_walls();
  void look_at_walls();
  [[nodiscard]] static Motion motion_of(const solver::Simulation& simulation, std::size_t body);
  [[nodiscard]] std::size_t body_of(const cases::Stop& stop) const;

  /// Returns a number that tells conditions from others, for checkpoints.
  [[nodiscard]] std::int64_t conditions() const;

  const cases::Case& setup_;
  std::filesystem::path folder_;
  Snapshots& snapshots_;
  io::Ranks ranks_;
  std::vector<Seen> seen_;            // of each condition
  std::optional<analysis::Run> run_;  // on the first rank, for the walls
  std::vector<std::optional<analysis::Wall>> walls_;
  std::vector<std::optional<analysis::Judge>> judges_;  // of conditions on outcomes
  std::size_t fed_ = 0;                                 // number of snapshots that the judges have seen
  std::int64_t judged_ = -1;                            // step of the last snapshot that was judged
  double before_ = 0.0, now_ = 0.0;  // s of wall time, before the last restart and up to now
  int found_ = 0;                    // number of the condition that holds, from 1
  int ended_ = 0;                    // number of the condition by which the run ends with this step
};

/// Checks that the conditions of a case name columns of its history.csv.
/// @param overrides  with which the case was read (--set)
/// @throws InputError naming file, line, key and the accepted columns
void require_known_columns(const cases::Case& setup,
                           const std::vector<std::pair<std::string, std::string>>& overrides);

}  // namespace whipple::run

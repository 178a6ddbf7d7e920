// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/io/history.hpp"
#include "src/io/ranks.hpp"
#include "src/run/observer.hpp"

namespace whipple::run {

/// Writes a row of numbers at a fixed interval of steps and at the end of a run (history.csv, gauges.csv).
class Table : public RunObserver {
 public:
  struct Options {
    std::filesystem::path file;
    std::string rows_name;             ///< key of the number of rows in checkpoints
    double Schedule::* every;          ///< steps between rows
    bool accept_missing_rows = false;  ///< continue although the file has lost rows
  };
  Table(Options options, const io::Ranks& ranks) : options_(std::move(options)), ranks_(ranks) {}

  void begin(const Moment& moment) override;
  /// Continues the file. Collective.
  /// @throws InputError if the file has other columns, or rows from before the checkpoint are missing
  void resume(const Moment& moment, const io::CheckpointValues& values) override;
  void after_step(const Moment& moment) override;
  void remember(io::CheckpointValues& values) override;

 protected:
  /// Returns the current values, on every rank; empty: no row is written. Collective.
  [[nodiscard]] virtual std::vector<io::HistoryValue> row(const solver::Simulation& simulation) = 0;
  /// Learns that the row of the current state was written.
  virtual void row_written(const solver::Simulation& /*simulation*/) {}

 private:
  void append(const Moment& moment);

  Options options_;
  io::Ranks ranks_;
  std::optional<io::History> table_;  // on the root
  std::int64_t last_step_ = -1;       // of the last row
};

}  // namespace whipple::run

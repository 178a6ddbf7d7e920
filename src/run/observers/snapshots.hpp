// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "src/io/background_writer.hpp"
#include "src/io/element_series.hpp"
#include "src/io/particle_series.hpp"
#include "src/io/ranks.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/observer.hpp"

namespace whipple::run {

/// Manages the files of the snapshots of a run: particles, and elements and trusses of cases that have them.
class SnapshotFiles {
 public:
  /// Reads run.toml for the provenance of the files.
  /// @param folder  output folder
  SnapshotFiles(const cases::Case& setup, const io::RunDirectory& directory,
                const std::filesystem::path& folder, MPI_Comm communicator);

  /// Removes the entries later than a checkpoint. Collective.
  void restart(double time);
  /// Writes the current state. Collective.
  void write(const solver::Simulation& simulation);
  /// Copies the current state and returns a function that writes it. For a run on one rank.
  [[nodiscard]] std::function<void()> prepare(const solver::Simulation& simulation);

  [[nodiscard]] const io::ParticleSeries& particles() const { return particles_; }

 private:
  io::ParticleSeries particles_;
  std::optional<io::ElementSeries> elements_;
};

/// Writes snapshots: at the start, at the multiples of the interval, at which steps end, on request, and at the end;
/// writes a state outside the range of the physics to the folder failed/.
class Snapshots : public RunObserver {
 public:
  Snapshots(const cases::Case& setup, const io::RunDirectory& directory, MPI_Comm communicator)
      : directory_(directory),
        ranks_(communicator),
        files_(setup, directory, directory.path(), communicator) {}

  void begin(const Moment& moment) override;
  void resume(const Moment& moment, const io::CheckpointValues& values) override;
  void after_step(const Moment& moment) override;
  [[nodiscard]] double next_time() const override;
  void remember(io::CheckpointValues& values) override;
  void end(const Moment& moment, Outcome& outcome) override;

  /// Returns the step of the last snapshot of this process, -1 before it, and waits until its files are complete.
  std::int64_t complete_last() {
    writer_.wait();
    return last_step_;
  }

 private:
  void write(const Moment& moment);

  io::RunDirectory directory_;
  io::Ranks ranks_;
  SnapshotFiles files_;
  io::BackgroundWriter writer_;  // writes the files
  double every_ = 0.0;           // s, interval of the schedule for which `next_` was computed
  std::int64_t next_ = 0;        // multiple of the interval at which the next snapshot is due
  std::int64_t last_step_ = -1;  // of the last snapshot
};

}  // namespace whipple::run

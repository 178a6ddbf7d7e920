// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "src/core/base/file_lock.hpp"
#include "src/core/base/files.hpp"

namespace whipple::io {

using whipple::write_text_atomically;

/// Locks a run directory against every other run for the lifetime of the returned object.
/// @throws InputError if there is no such folder, or another run holds the lock
std::shared_ptr<const FileLock> lock_run(const std::filesystem::path& path);

/// Returns whether a process holds the lock of a run directory.
bool is_running(const std::filesystem::path& path);

/// Manages the folder of all output of one run (docs/manual/output.md). Used by one process.
class RunDirectory {
 public:
  /// Creates the folder and locks it for the lifetime of this object and its copies. An existing folder must be empty
  /// unless `force` is set: then the outputs of an earlier run in it (and nothing else) are removed.
  /// @param name  the run's name RUN in RUN.particles.hdf.series
  /// @throws InputError if it is not empty and `force` is not set, is not a folder, is not writable, or another run
  /// holds the lock
  static RunDirectory create(const std::filesystem::path& path, const std::string& name, bool force);

  /// Opens the folder of an earlier run to continue it.
  /// @throws InputError if it is missing, contains no run.toml, or is not writable
  static RunDirectory open(const std::filesystem::path& path, const std::string& name);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::filesystem::path input_file() const { return path_ / "run.toml"; }
  [[nodiscard]] std::filesystem::path history_file() const { return path_ / "history.csv"; }
  [[nodiscard]] std::filesystem::path gauges_file() const { return path_ / "gauges.csv"; }
  [[nodiscard]] std::filesystem::path status_file() const { return path_ / "status.json"; }
  /// Returns the folder for requests to the run; `steering_file` is the table of their answers.
  [[nodiscard]] std::filesystem::path control_folder() const { return path_ / "control"; }
  [[nodiscard]] std::filesystem::path steering_file() const { return path_ / "steering.csv"; }
  [[nodiscard]] std::filesystem::path log_file() const { return path_ / "log.txt"; }
  [[nodiscard]] std::filesystem::path profile_file() const { return path_ / "profile.json"; }
  [[nodiscard]] std::filesystem::path checkpoint_folder() const { return path_ / "checkpoint"; }
  /// Returns the folder for the state in which a run failed.
  [[nodiscard]] std::filesystem::path failed_folder() const { return path_ / "failed"; }

  /// Writes run.toml: the complete input with all defaults.
  void write_input(std::string_view text) const { write_text_atomically(input_file(), text); }

  /// Removes incomplete files left by a killed run; called while holding the lock.
  void remove_partial_files() const;

  /// Checks the free space.
  /// @throws InputError if the file system has less than `bytes` available
  void require_free_space(std::uint64_t bytes) const;

 private:
  RunDirectory(std::filesystem::path path, std::string name)
      : path_(std::move(path)), name_(std::move(name)) {}
  std::filesystem::path path_;
  std::string name_;
  std::shared_ptr<const FileLock> lock_;
};

}  // namespace whipple::io

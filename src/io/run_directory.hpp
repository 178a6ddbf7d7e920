// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace whipple::io {

/// Replaces a text file as a whole: readers see the old or the new text, never a part.
/// @throws InputError naming the file and the reason of the system
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

/// @throws InputError naming the file
std::string read_text(const std::filesystem::path& path);

/// The folder that holds all output of one run (docs/output.md). One process makes it.
class RunDirectory {
 public:
  /// Makes the folder. One that exists must be empty, unless `force`: then the outputs of an earlier run in
  /// it (and nothing else) are removed.
  /// @param name the run's name RUN in RUN.particles.hdf.series
  /// @throws InputError if it holds something and `force` is not set, is not a folder, or is not writable
  static RunDirectory create(const std::filesystem::path& path, const std::string& name, bool force);

  /// A folder of an earlier run, to go on with.
  /// @throws InputError if it is missing, holds no run.toml, or is not writable
  static RunDirectory open(const std::filesystem::path& path, const std::string& name);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::filesystem::path input_file() const { return path_ / "run.toml"; }
  [[nodiscard]] std::filesystem::path history_file() const { return path_ / "history.csv"; }
  [[nodiscard]] std::filesystem::path log_file() const { return path_ / "log.txt"; }
  [[nodiscard]] std::filesystem::path profile_file() const { return path_ / "profile.json"; }
  [[nodiscard]] std::filesystem::path checkpoint_folder() const { return path_ / "checkpoint"; }
  /// Where the state goes that ended a run.
  [[nodiscard]] std::filesystem::path failed_folder() const { return path_ / "failed"; }

  /// Writes run.toml: the complete input with all defaults.
  void write_input(std::string_view text) const { write_text_atomically(input_file(), text); }

  /// @throws InputError if the file system has less than `bytes` free
  void require_free_space(std::uint64_t bytes) const;

 private:
  RunDirectory(std::filesystem::path path, std::string name)
      : path_(std::move(path)), name_(std::move(name)) {}
  std::filesystem::path path_;
  std::string name_;
};

}  // namespace whipple::io

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace whipple::process {

/// Represents a program that runs beside this one, and is ended with everything that it started when it is not wanted
/// any more. It also ends with this process, even if that is killed.
class Job {
 public:
  /// Starts a program. Its standard input is empty.
  /// @param output, errors  files that are created
  /// @param temporary       folder of its temporary files, as it cannot remove them when it is ended
  /// @throws InputError if it cannot be started
  Job(const std::vector<std::string>& arguments, const std::filesystem::path& output,
      const std::filesystem::path& errors, const std::filesystem::path& temporary);
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
  /// Ends the program, if it still runs, at once.
  ~Job();

  /// Returns its exit code, or 128 + the signal that ended it; nothing while it runs.
  std::optional<int> code();

 private:
  pid_t pid_ = 0;
  std::optional<int> code_;
};

}  // namespace whipple::process

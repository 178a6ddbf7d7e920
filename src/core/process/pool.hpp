// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace whipple::process {

/// Runs programs side by side. During its lifetime SIGINT and SIGTERM to this process are held back: `wait` passes them
/// on to all programs as SIGTERM. The programs end with this process (SIGTERM), even if it is killed. Create it before
/// any thread, which would receive the signals otherwise.
class Pool {
 public:
  Pool();
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  /// Ends programs that still run, by SIGTERM, and waits for them.
  ~Pool();

  /// Starts a program. Its standard input is empty; its output is appended to a file.
  /// @param tag  returned by `wait` when it has ended
  /// @throws InputError if it cannot be started, a missing program included
  void start(std::size_t tag, const std::vector<std::string>& arguments, const std::filesystem::path& output);

  [[nodiscard]] std::size_t running() const { return running_.size(); }

  /// Describes how a program ended.
  struct Ended {
    std::size_t tag;
    int code;    ///< its exit code; 128 + signal if one ended it
    int signal;  ///< that ended it; 0: it ended by itself
  };
  /// Waits until a program ends, but at most some time. @param patience  s
  /// @returns nothing after that time
  std::optional<Ended> wait(double patience = 0.2);

  /// Takes a signal that has arrived, and passes it on; for work between two calls of `wait`.
  /// @returns whether this process is asked to end
  bool is_asked_to_end();

  /// Returns the signal that asked this process to end; 0: none taken yet. No program is to be started after it.
  [[nodiscard]] int stopped_by() const { return stopped_by_; }

 private:
  void take(int signal);

  std::map<pid_t, std::size_t> running_;
  sigset_t held_{}, former_{};
  int stopped_by_ = 0;
};

}  // namespace whipple::process

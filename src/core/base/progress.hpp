// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace whipple {

/// Shows the progress of long operations on standard error: a bar with rate and remaining time on a terminal, otherwise
/// one line per minute. The cost is one clock reading per update.
class Progress {
 public:
  /// Starts the display.
  /// @param label  name of the operation, e.g. "run"
  /// @param total  amount of work in the unit passed to `update`
  Progress(std::string label, double total);
  Progress(const Progress&) = delete;  // one bar, one line of the terminal
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Updates the progress.
  /// @param done    work done so far, in the unit of `total`
  /// @param remark  short text behind the bar, e.g. "step 120, t = 1.2 us"
  void update(double done, const std::string& remark);
  /// Sets the work done before this process began (restart), which is excluded from the rate.
  void start_from(double done);

 private:
  using Clock = std::chrono::steady_clock;
  void print(double done, const std::string& remark, bool last);

  std::string label_;
  double total_;
  double first_ = 0.0;
  double last_done_ = 0.0;
  std::string last_remark_;
  bool terminal_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point printed_ = Clock::now();
};

/// Shows or hides all bars of the process (--quiet).
void set_progress_visible(bool visible);

}  // namespace whipple

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple::run {

/// Catches SIGINT, SIGTERM (end the run) and SIGUSR1 (write a checkpoint) while it lives. SIGUSR2 counts as
/// SIGTERM: it is the one that mpirun passes on to its ranks without killing them a second later.
class Signals {
 public:
  Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  ~Signals();

  /// Number of the signal that asked for the end, 0 if none.
  [[nodiscard]] int end_requested() const;
  /// True once per request.
  [[nodiscard]] bool checkpoint_requested() const;
};

}  // namespace whipple::run

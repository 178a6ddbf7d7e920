// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/run/control.hpp"

namespace whipple::run {

/// Catches signals during its lifetime: SIGINT and SIGTERM end the run, SIGUSR1 writes a checkpoint. SIGUSR2 counts as
/// SIGTERM: mpirun passes it on to its ranks without killing them a second later. One of several ranks that waits for
/// another one forever never reaches the end of a step: it terminates itself after `patience`. Writing has a longer
/// limit, because files of many particles on a slow disk need more time.
class SignalControl : public RunControl {
 public:
  static constexpr unsigned patience = 120;               ///< s, from a signal to the end of the step
  static constexpr unsigned patience_of_writing = 3'600;  ///< s, for writing between two steps
  /// Bounds the time (s) from a signal during writing, over the following step, to the end of its checkpoint.
  static constexpr unsigned longest_end = 2 * patience_of_writing + patience;

  explicit SignalControl(bool one_of_several);
  SignalControl(const SignalControl&) = delete;
  SignalControl& operator=(const SignalControl&) = delete;
  ~SignalControl() override;

  void ask(const Moment& moment, Requests& requests) override;
  void writing_begins() override;
  void step_begins() override;
};

}  // namespace whipple::run

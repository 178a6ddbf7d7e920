// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/run/control.hpp"

namespace whipple::run {

/// Catches signals while it lives: SIGINT and SIGTERM end the run, SIGUSR1 writes a checkpoint. SIGUSR2 counts as
/// SIGTERM: it is the one that mpirun passes on to its ranks without killing them a second later. A rank of several that
/// waits for another one for ever reaches no end of a step: it ends itself after `patience`. Files are given more time, as
/// those of many particles on a slow disk need.
class SignalControl : public RunControl {
 public:
  static constexpr unsigned patience = 120;               ///< s, from a signal to the end of the step
  static constexpr unsigned patience_of_writing = 3'600;  ///< s, for what is written at one border
  /// s, from a signal while something is written, over the step after it, to the end of its checkpoint.
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/run/control.hpp"

namespace whipple::run {

/// Catches signals while it lives: SIGINT and SIGTERM end the run, SIGUSR1 writes a checkpoint. SIGUSR2 counts as
/// SIGTERM: it is the one that mpirun passes on to its ranks without killing them a second later. A rank of several
/// that waits for another one for ever reaches no end of a step: it ends itself after `patience`.
class SignalControl : public RunControl {
 public:
  static constexpr unsigned patience =
      120;  ///< s, from the signal to the end of the step, and from there to the end
  explicit SignalControl(bool one_of_several);
  SignalControl(const SignalControl&) = delete;
  SignalControl& operator=(const SignalControl&) = delete;
  ~SignalControl() override;

  void ask(const Moment& moment, Requests& requests) override;

 private:
  bool noticed_ = false;
};

}  // namespace whipple::run

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/run/control.hpp"

namespace whipple::run {

/// Catches signals while it lives: SIGINT and SIGTERM end the run, SIGUSR1 writes a checkpoint. SIGUSR2 counts as
/// SIGTERM: it is the one that mpirun passes on to its ranks without killing them a second later.
class SignalControl : public RunControl {
 public:
  SignalControl();
  SignalControl(const SignalControl&) = delete;
  SignalControl& operator=(const SignalControl&) = delete;
  ~SignalControl() override;

  void ask(const Moment& moment, Requests& requests) override;
};

}  // namespace whipple::run

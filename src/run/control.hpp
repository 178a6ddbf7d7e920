// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/run/requests.hpp"

namespace whipple::run {

struct Moment;

/// Everything that is asked of a run at one border between steps.
struct Requests {
  int signal = 0;            ///< number of the signal that ends the run
  bool out_of_time = false;  ///< the limit of wall time ends the run
  bool checkpoint = false;
  Request steering;

  /// Returns whether the run ends before its time.
  [[nodiscard]] bool stop() const { return signal != 0 || out_of_time || steering.act == Act::stop; }
};

/// Asks things of a run. The loop calls it on every rank after each step, and again and again while the run is
/// paused; what one rank asks for, all do.
class RunControl {
 public:
  virtual ~RunControl() = default;

  /// Adds what is asked now. Called without communication between the ranks; only the first rank may fill in
  /// `steering`, and only where it is still empty.
  virtual void ask(const Moment& moment, Requests& requests) = 0;

  /// Is told that all ranks have come to the border, where they write files, which may take long.
  virtual void writing_begins() {}
  /// Is told that what was to be written is, and that a step begins.
  virtual void step_begins() {}

  /// Is told that the run has ended: nothing is asked for any more.
  virtual void end(const Moment&) {}
};

}  // namespace whipple::run

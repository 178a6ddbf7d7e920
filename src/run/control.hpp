// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/run/requests.hpp"

namespace whipple::run {

struct Moment;

/// Holds all requests to a run between two steps.
struct Requests {
  int signal = 0;            ///< number of the signal that ends the run
  bool out_of_time = false;  ///< the limit of wall time ends the run
  bool checkpoint = false;
  Request steering;
  int condition = 0;  ///< number of the entry [[stop]] that holds, from 1; 0: none

  /// Returns whether the run ends before its end time.
  [[nodiscard]] bool stop() const { return signal != 0 || out_of_time || steering.act == Act::stop; }
};

/// Collects requests to a run. The loop calls it on every rank after each step, and repeatedly while the run is paused;
/// the requests of one rank apply to all.
class RunControl {
 public:
  virtual ~RunControl() = default;

  /// Adds the current requests. Called without communication between the ranks; only the first rank may set `steering`,
  /// and only if it is still empty.
  virtual void ask(const Moment& moment, Requests& requests) = 0;

  /// Signals that all ranks have finished a step and now write files, which may take long.
  virtual void writing_begins() {}
  /// Signals that writing is finished and a step begins.
  virtual void step_begins() {}

  /// Signals that the run has ended and that no further requests are accepted.
  virtual void end(const Moment&) {}
};

}  // namespace whipple::run

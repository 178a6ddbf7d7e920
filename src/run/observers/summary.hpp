// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/io/ranks.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/observer.hpp"

namespace whipple::run {

/// Prints a summary at the end of a run, and writes the wall-clock time of its stages to profile.json.
class Summary : public RunObserver {
 public:
  /// @param profile  of the simulation, which must outlive this object
  Summary(const io::RunDirectory& directory, const solver::Profile& profile, const io::Ranks& ranks)
      : directory_(directory), profile_(profile), ranks_(ranks) {}

  void end(const Moment& moment, Outcome& outcome) override;

 private:
  io::RunDirectory directory_;
  const solver::Profile& profile_;
  io::Ranks ranks_;
};

}  // namespace whipple::run

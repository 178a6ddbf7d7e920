// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/io/ranks.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/observer.hpp"

namespace whipple::run {

/// Updates run.toml, the input of the run: a request that changes the schedule is written into it, so that a restart
/// uses the changed value.
class InputRecord : public RunObserver {
 public:
  InputRecord(const io::RunDirectory& directory, const io::Ranks& ranks)
      : directory_(directory), ranks_(ranks) {}

  void after_step(const Moment& moment) override;

 private:
  io::RunDirectory directory_;
  io::Ranks ranks_;
};

}  // namespace whipple::run

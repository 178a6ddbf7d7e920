// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

#include "src/io/run_directory.hpp"
#include "src/run/observer.hpp"

namespace whipple::run {

/// Writes checkpoints on request (including those of the loop's clock) and at the end; writes a state outside the range
/// of the physics to the folder failed/.
class Checkpoints : public RunObserver {
 public:
  explicit Checkpoints(const io::RunDirectory& directory) : directory_(directory) {}

  void after_step(const Moment& moment) override;
  void end(const Moment& moment, Outcome& outcome) override;

 private:
  void write(const Moment& moment, const std::filesystem::path& folder) const;

  io::RunDirectory directory_;
  std::int64_t last_step_ = -1;  // of the last checkpoint
};

}  // namespace whipple::run

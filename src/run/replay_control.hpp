// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <utility>

#include "src/run/control.hpp"

namespace whipple::run {

/// Repeats the requests to an earlier run: the accepted requests of its steering.csv, each after the step after which
/// it was executed. The same case on the same ranks and threads then gives bitwise identical results. Used on the first
/// rank only.
class ReplayControl : public RunControl {
 public:
  /// Reads the table.
  /// @throws InputError naming file and line if the table is damaged, or if its steps decrease: the run was continued
  /// from a checkpoint earlier than a request, and the table does not define the effective sequence
  explicit ReplayControl(const std::filesystem::path& table);

  void ask(const Moment& moment, Requests& requests) override;

 private:
  std::deque<std::pair<std::int64_t, Request>> rows_;  // step, request
};

}  // namespace whipple::run

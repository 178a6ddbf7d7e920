// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace whipple {

/// Reports that a run cannot continue for lack of disk space or memory; its last state was saved. The exit code is
/// `ExitCode::state`.
class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace whipple

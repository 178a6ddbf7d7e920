// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace whipple {

/// A run cannot go on for want of disk or memory; its last state was saved. Ends with `ExitCode::state`.
class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace whipple

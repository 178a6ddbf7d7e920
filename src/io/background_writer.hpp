// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <system_error>
#include <utility>

#include "src/core/parallel/threads.hpp"

namespace whipple::io {

/// Writes behind the time steps, on a thread of its own. HDF5 serves one thread at a time: whoever opens a
/// file waits first.
class BackgroundWriter {
 public:
  /// Starts when what was started before has ended.
  /// @throws what that one threw
  void start(std::function<void()> write) {
    wait();
    const auto work = std::make_shared<std::function<void()>>(std::move(write));
    try {
      under_way_ = std::async(std::launch::async, [work] {
        parallel::set_threads(1);  // of this thread
        (*work)();
      });
    } catch (const std::system_error&) {  // no further thread to be had (ulimit)
      (*work)();
    }
  }
  /// @throws what the writing threw
  void wait() {
    if (under_way_.valid()) under_way_.get();
  }

 private:
  std::future<void> under_way_;  // of std::async: its destructor waits
};

}  // namespace whipple::io

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <system_error>
#include <utility>

#include "src/core/parallel/threads.hpp"

namespace whipple::io {

/// Writes files concurrently with the time steps, on a separate thread. HDF5 is not thread-safe: call `wait` before
/// opening a file.
class BackgroundWriter {
 public:
  /// Starts a write after the previous one has ended.
  /// @throws the exception of the previous write
  void start(std::function<void()> write) {
    wait();
    const auto work = std::make_shared<std::function<void()>>(std::move(write));
    try {
      under_way_ = std::async(std::launch::async, [work] {
        parallel::set_threads(1);  // of this thread
        (*work)();
      });
    } catch (const std::system_error&) {  // no further thread available (ulimit)
      (*work)();
    }
  }
  /// Waits for the current write.
  /// @throws the exception of the write
  void wait() {
    if (under_way_.valid()) under_way_.get();
  }

 private:
  std::future<void> under_way_;  // of std::async: its destructor waits
};

}  // namespace whipple::io

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "src/core/parallel/threads.hpp"

namespace whipple::quasi_static {

/// Calls body(i) for i in [0, n), on all threads if that is worth their waiting for each other.
template <class Body>
void for_each(std::size_t n, Body&& body) {
  constexpr std::size_t worth_threads = 4096;
  if (n < worth_threads) {
    for (std::size_t i = 0; i < n; ++i) body(i);
  } else {
    parallel::for_each_uneven(n, body);
  }
}

}  // namespace whipple::quasi_static

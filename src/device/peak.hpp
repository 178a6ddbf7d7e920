// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>

#include "src/device/bins.hpp"
#include "src/device/engine.hpp"

namespace whipple::device {

/// Multiplies and adds in eight independent rows, whose results are stored.
struct MultiplyAdds {
  static constexpr int rows = 8, turns = 512;
  double* to;
  WHIPPLE_POINT void operator()(std::size_t i) const {
    double x[rows];
    for (int k = 0; k < rows; ++k) x[k] = 1e-3 * static_cast<double>(i % 97) + k;
    for (int turn = 0; turn < turns; ++turn) {
#ifdef __CUDA_ARCH__
#pragma unroll
#endif
      for (int k = 0; k < rows; ++k) x[k] = std::fma(x[k], 0.999999, 1e-6);
    }
    double sum = 0.0;
    for (int k = 0; k < rows; ++k) sum += x[k];
    to[i] = sum;
  }
};

/// Measures what a space can do at most: the best of several copies, and of several rows of multiply-adds.
template <class Space>
Rates measured_rates(Space& space) {
  constexpr std::size_t n = std::size_t{1} << 25U;  // 256 MB each
  constexpr std::size_t threads = std::size_t{1} << 20U;
  typename Space::template Array<double> from, to;
  from.reserve(n);
  to.reserve(n);
  space.for_each(n, Fill<double>{from.data(), 1.0});
  const auto best = [&](auto&& work) {
    double least = 1e300;
    for (int i = 0; i < 6; ++i) {
      space.synchronize();
      const auto begin = std::chrono::steady_clock::now();
      work();
      space.synchronize();
      least =
          std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return least;
  };
  const double copy = best([&] { space.for_each(n, Copy<double>{from.data(), to.data()}); });
  const double sums = best([&] { space.for_each(threads, MultiplyAdds{to.data()}); });
  return {2.0 * sizeof(double) * static_cast<double>(n) / copy,
          2.0 * MultiplyAdds::rows * MultiplyAdds::turns * static_cast<double>(threads) / sums};
}

}  // namespace whipple::device

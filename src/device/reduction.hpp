// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "src/core/base/dialect.hpp"

namespace whipple::device {

/// Sums and maxima over a range. They are taken over fixed parts of it, in a fixed order.
template <std::size_t Sums, std::size_t Maxima>
struct Reduction {
  static constexpr std::size_t sums = Sums, maxima = Maxima;
  std::array<double, Sums> sum{};
  std::array<double, Maxima> largest{};  ///< at least 0

  WHIPPLE_POINT void merge(const Reduction& other) {
    for (std::size_t k = 0; k < Sums; ++k) sum[k] += other.sum[k];
    for (std::size_t k = 0; k < Maxima; ++k) raise(k, other.largest[k]);
  }
  /// Raises a maximum; NaN does not.
  WHIPPLE_POINT void raise(std::size_t k, double value) {
    if (value > largest[k]) largest[k] = value;
  }
};

}  // namespace whipple::device

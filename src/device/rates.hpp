// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "src/device/points.hpp"
#include "src/device/reduction.hpp"

/// Compression rate of most of the mass, which bounds the time step (docs/theory/mpm.md, section 6).
namespace whipple::device {

/// Bins positive numbers by exponent and first four bits of the mantissa: bins 3 to 6 % wide, from 1 to 2^40.
struct RateBins {
  static constexpr std::size_t octaves = 40, in_octave = 16, count = octaves * in_octave;
  static WHIPPLE_POINT std::size_t of(double x) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) >> 48U,
                        one = std::bit_cast<std::uint64_t>(1.0) >> 48U;
    return bits <= one ? 0 : std::min<std::size_t>(bits - one, count - 1);
  }
  static double end(std::size_t bin) {
    const std::uint64_t one = std::bit_cast<std::uint64_t>(1.0) >> 48U;
    return std::bit_cast<double>((one + bin + 1) << 48U);
  }
};
/// Number of parts into which the mass is divided: sums of whole numbers do not depend on the order.
constexpr double parts_of_mass = 0x1p40;

/// Sums the masses, in parts, of particles under pressure that close faster than a rate, by bins.
template <std::size_t bins>
struct MassByRate {
  using Result = Reduction<bins, 0>;
  Points points;
  double above;              ///< 1/s
  double per_mass;           ///< parts per kg
  std::size_t first, width;  ///< bin of RateBins at which these begin, and how many of them each has

  WHIPPLE_POINT void operator()(std::size_t p, Result& result) const {
    const double rate = points.at(closing_rate, p);
    if (rate <= above || points.at(pressure, p) <= 0.0) return;
    const std::size_t bin = RateBins::of(rate);
    if (bin < first) return;
    const double parts = std::rint(per_mass * points.at(mass, p));
    for (std::size_t k = 0; k < bins; ++k) result.sum[k] += (bin - first) / width == k ? parts : 0.0;
  }
};

/// Returns a rate (1/s) that at most the fraction `share` of the total mass exceeds: the end of a bin, at most `largest`,
/// or `least`, below which no particle is asked.
template <class Space>
double rate_of_most(Space& space, const Points& points, double total_mass, double share, double least,
                    double largest) {
  const double per_mass = parts_of_mass / total_mass;
  const auto octaves = space.reduce(
      points.size, MassByRate<RateBins::octaves>{points, least, per_mass, 0, RateBins::in_octave});
  double faster = 0.0;
  for (std::size_t octave = RateBins::octaves; octave-- > 0;) {
    if (faster + octaves.sum[octave] <= share * parts_of_mass) {
      faster += octaves.sum[octave];
      continue;
    }
    const std::size_t first = octave * RateBins::in_octave;
    const auto fine =
        space.reduce(points.size, MassByRate<RateBins::in_octave>{points, least, per_mass, first, 1});
    for (std::size_t k = RateBins::in_octave; k-- > 0;) {
      faster += fine.sum[k];
      if (faster > share * parts_of_mass) return std::min(largest, RateBins::end(first + k));
    }
  }
  return least;
}

}  // namespace whipple::device

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "src/core/base/dialect.hpp"

/// State of one point as an equation of state gives it, for evaluations without its object: kernels of a graphics processor.
namespace whipple::eos {

/// Reasons for which the state of a point is out of range, in the order of their bits, and what else is counted.
enum class PointEvent : std::uint8_t {
  none = 0,
  not_a_number = 1,      ///< density not positive, density or energy not finite
  density = 2,           ///< density outside of the model
  energy = 4,            ///< energy above the table
  below_cold_curve = 8,  ///< energy below that of the lowest temperature: evaluated there
};
constexpr std::uint8_t point_out_of_range = 7;  ///< bits of the events after which the state is NaN

struct PointState {
  double pressure, temperature, sound_speed;  ///< Pa, K, m/s (bulk)
  double melted, vaporised;                   ///< mass fractions
  std::uint8_t events;                        ///< bits of `PointEvent`
};

/// Returns the state of a point that is out of range.
WHIPPLE_POINT inline PointState unknown_point(PointEvent reason) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return {unknown, unknown, unknown, unknown, unknown, static_cast<std::uint8_t>(reason)};
}

}  // namespace whipple::eos

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/core/base/dialect.hpp"

/// What first contacts of fields need of a step (contact::FirstTouches).
namespace whipple::device {

/// Returns the number of a pair of fields, first < second.
[[nodiscard]] WHIPPLE_POINT constexpr std::uint32_t pair_of_fields(std::uint32_t first,
                                                                   std::uint32_t second) {
  return second * (second - 1) / 2 + first;
}
[[nodiscard]] constexpr std::size_t pairs_of_fields(std::size_t fields) { return fields * (fields - 1) / 2; }

/// Describes the approach of two fields at a node. Surfaces that do not close cannot touch.
struct Approach {
  double open = 0.0;       ///< distance of the surfaces, m; <= 0: they touch
  double closing = 0.0;    ///< closing speed after the step without contact, m/s
  std::uint32_t pair = 0;  ///< of fields
};

/// Holds the approaches of a pair of fields that decide: given to contact::FirstTouches::see in the place of all of
/// them, these two have the same outcome.
struct DecidingApproaches {
  Approach soonest, hardest;
};

/// Finds the deciding ones of pair of fields i % pairs among those of chunk i / pairs of the contact pairs. The engine
/// combines the chunks by `combine`, in any order.
struct FindDecidingApproaches {
  static constexpr std::size_t chunk = 256;

  const Approach* approach;  ///< of each contact pair
  std::size_t count;
  std::uint32_t pairs;  ///< of fields
  double dt;            ///< s
  double least_speed;   ///< minimum closing speed of contacts that limit the time step, m/s
  DecidingApproaches* deciding;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto pair = static_cast<std::uint32_t>(i % pairs);
    const std::size_t begin = i / pairs * chunk, end = begin + chunk < count ? begin + chunk : count;
    DecidingApproaches found{};
    found.soonest.pair = found.hardest.pair = pair;
    for (std::size_t k = begin; k < end; ++k) {
      if (approach[k].pair == pair) combine(found, approach[k]);
    }
    deciding[i] = found;
  }
  WHIPPLE_POINT void combine(DecidingApproaches& into, const Approach& one) const {
    if (time_of(one) < time_of(into.soonest)) into.soonest = one;
    if (is_hard(one) && !is_hard(into.hardest)) into.hardest = one;
  }
  WHIPPLE_POINT void combine(DecidingApproaches& into, const DecidingApproaches& other) const {
    combine(into, other.soonest);
    combine(into, other.hardest);
  }

 private:
  static constexpr double never = 1e300;
  /// Returns the time to contact, s: 0 within the step; never, if the approach is slow.
  [[nodiscard]] WHIPPLE_POINT double time_of(const Approach& one) const {
    if (!(one.closing > 0.0)) return never;
    if (touches(one)) return 0.0;
    return one.closing >= least_speed ? one.open / one.closing : never;
  }
  [[nodiscard]] WHIPPLE_POINT bool is_hard(const Approach& one) const {
    return one.closing > 0.0 && one.closing >= least_speed && touches(one);
  }
  /// Returns whether the surfaces touch in the step (contact::touches_in).
  [[nodiscard]] WHIPPLE_POINT bool touches(const Approach& one) const {
    return one.open < (1.0 + 1e-9) * dt * one.closing;
  }
};

}  // namespace whipple::device

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "src/case/section.hpp"
#include "src/core/base/words.hpp"

namespace whipple::cases {

/// Selects what ends a run before `time.end`.
enum class StopWhen : std::uint8_t { perforated, decided, speed_below, energy_below, settled, wall_time };
constexpr std::array<Word<StopWhen>, 6> words(StopWhen) {
  return {{{StopWhen::perforated, "perforated"},
           {StopWhen::decided, "decided"},
           {StopWhen::speed_below, "speed_below"},
           {StopWhen::energy_below, "energy_below"},
           {StopWhen::settled, "settled"},
           {StopWhen::wall_time, "wall_time"}}};
}

/// Describes a condition that ends a run; the first of several that holds does.
struct Stop {
  static constexpr double not_given = std::numeric_limits<double>::infinity();

  StopWhen when = StopWhen::perforated;
  std::string body, column;
  double speed = not_given;      ///< m/s
  double energy = not_given;     ///< J
  double change = not_given;     ///< of the column, relative to its largest magnitude so far
  double over = not_given;       ///< s, simulated, in which the column changes less
  double wall_time = not_given;  ///< s
  double after = 0.0;            ///< s, simulated, before which the condition is not asked for

  static ParameterTable<Stop> parameters();
  void check(const Case& setup, const Faults& faults) const;

  /// Returns the condition in words, `body "wall" is perforated`.
  [[nodiscard]] std::string in_words() const;
};

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace whipple::sweep {

/// Tells on which side of its threshold a quantity is; undecided where it has no value, or variants disagree.
enum class Verdict : std::uint8_t { below, undecided, above };

/// Holds the verdict at a value of the sought key.
struct Judged {
  double at = 0.0;
  Verdict verdict = Verdict::undecided;
};

/// Returns the values to compute next: the middles of all neighbours with different verdicts that are farther apart
/// than the tolerance. The search ends when there are none; each change of a verdict is then narrower than it.
/// @param judged  in increasing order
std::vector<double> next_values(std::span<const Judged> judged, double tolerance);

/// Describes what the verdicts say of the limit.
struct Limit {
  enum class Kind : std::uint8_t { found, none, not_monotone };
  Kind kind = Kind::none;
  double lower = 0.0, upper = 0.0;  ///< of `found`: the limit lies between them; undecided values lie inside
  bool rises = true;                ///< of `found`: the quantity is below its threshold below the limit
  std::vector<std::pair<double, double>>
      changes;  ///< of `not_monotone`: all intervals in which the verdict changes
};

/// Reads the limit off the verdicts: one change from one side to the other, with undecided values between at most.
Limit limit_of(std::span<const Judged> judged);

/// Returns the interval that contains the limits of all variants; nothing if one has none, or they change in opposite
/// directions.
std::optional<std::pair<double, double>> hull(std::span<const Limit> limits);

}  // namespace whipple::sweep

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/data_set/data_set.hpp"

namespace whipple::md {

/// How exactly a point is wanted. Neither number enters its key: a plan that asks for more continues the
/// points that are there.
struct Precision {
  std::string quantity;       ///< the result that decides; empty: one segment, whatever its error
  double target_error = 0.0;  ///< of that result; 0: any
  bool relative = false;      ///< the target is a fraction of the value
  std::int64_t segments = 1;  ///< at most so many
};

/// Returns whether another segment is to be added to a finished point. The error of n replicas counts with its own
/// standard error added, 1/sqrt(2 (n - 1)) of it.
bool wants_more(const PointRecord& point, const Precision& precision);

/// Joins a finished point with one more segment, an independent run of the same length: means of the values
/// weighted by the number of segments. Two parts that differ by more than two standard errors of their
/// difference have not seen the same states, and the error grows in proportion. A flag holds if it holds in
/// both parts. Points of replicas (provenance "replicas") become one larger set of them.
PointRecord join(const PointRecord& point, const PointRecord& segment);

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/data_set/data_set.hpp"

namespace whipple::md {

/// Specifies the target accuracy of a point. Neither number enters its key: a plan with a smaller target error
/// continues the existing points.
struct Precision {
  std::string quantity;       ///< the decisive result; empty: one segment, whatever its error
  double target_error = 0.0;  ///< of that result; 0: any
  bool relative = false;      ///< the target is a fraction of the value
  std::int64_t segments = 1;  ///< maximum number of segments
};

/// Returns whether another segment is needed for a finished point. The error of n replicas is increased by its
/// standard error, a fraction 1/sqrt(2 (n - 1)).
bool wants_more(const PointRecord& point, const Precision& precision);

/// Joins a finished point with one more segment, an independent run of the same length: means of the values
/// weighted by the number of segments. Two parts that differ by more than two standard errors of their difference
/// have not sampled the same states, and the error grows in proportion. A flag is set if it is set in both parts.
/// Points of replicas (provenance "replicas") become one larger set.
PointRecord join(const PointRecord& point, const PointRecord& segment);

}  // namespace whipple::md

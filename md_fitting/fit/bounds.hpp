// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace whipple::fit {

/// Holds the open interval of a fitted constant; infinite: no bound.
struct Bounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// Represents a bounded constant by an unbounded parameter: any real p is mapped into the open interval, p = 0 onto
/// the start value v0 (docs/theory/fit.md, section 2):
///   no bound: v0 + scale p;  one bound b: b + (v0 - b) e^(+-p);  two: the logistic function of p +
///   logit(v0).
class BoundedParameter {
 public:
  /// @param scale  of a constant without bounds, chosen such that p is of order one
  /// @throws StateError if the start value is not inside
  BoundedParameter(double start, const Bounds& bounds, double scale = 1.0);

  [[nodiscard]] double value(double p) const;
  /// Returns d(value)/dp.
  [[nodiscard]] double slope(double p) const;

 private:
  enum class Kind { free, above, below, between };
  Kind kind_;
  double start_, scale_;
  Bounds bounds_;
  double logit_ = 0.0;
};

}  // namespace whipple::fit

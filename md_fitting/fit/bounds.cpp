// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/bounds.hpp"

#include <fmt/format.h>

#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::fit {

BoundedParameter::BoundedParameter(double start, const Bounds& bounds, double scale)
    : kind_(std::isfinite(bounds.lower) ? (std::isfinite(bounds.upper) ? Kind::between : Kind::above)
                                        : (std::isfinite(bounds.upper) ? Kind::below : Kind::free)),
      start_(start),
      scale_(scale),
      bounds_(bounds) {
  if (!(start > bounds.lower && start < bounds.upper)) {
    throw StateError(fmt::format("the start value {:.6g} is not between {:.6g} and {:.6g}", start,
                                 bounds.lower, bounds.upper));
  }
  if (kind_ == Kind::between) logit_ = std::log((start - bounds.lower) / (bounds.upper - start));
}

double BoundedParameter::value(double p) const {
  switch (kind_) {
    case Kind::free:
      return start_ + scale_ * p;
    case Kind::above:
      return bounds_.lower + (start_ - bounds_.lower) * std::exp(p);
    case Kind::below:
      return bounds_.upper - (bounds_.upper - start_) * std::exp(-p);
    case Kind::between:
      return bounds_.lower + (bounds_.upper - bounds_.lower) / (1.0 + std::exp(-logit_ - p));
  }
  return start_;
}

double BoundedParameter::slope(double p) const {
  const double v = value(p);
  switch (kind_) {
    case Kind::free:
      return scale_;
    case Kind::above:
      return v - bounds_.lower;
    case Kind::below:
      return bounds_.upper - v;
    case Kind::between:
      return (v - bounds_.lower) * (bounds_.upper - v) / (bounds_.upper - bounds_.lower);
  }
  return scale_;
}

}  // namespace whipple::fit

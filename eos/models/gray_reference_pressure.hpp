// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/models/shock_curve.hpp"
#include "src/core/base/vector_math.hpp"

namespace whipple::eos {

/// Returns (P1a V0/C^2)(x) of (G5) and its first two derivatives: x/y^2 of the shock curve times 1 - n/(2 (1 - x)),
/// n = gamma x = gamma0 x - a x^2. S2 and S3 are fitted in compression; in tension, where they may reverse the
/// pressure at a few per cent of strain, S1 alone continues the curve (two derivatives are continuous).
template <class Number>
ShockCurve::Derivatives<Number> gray_reference_pressure(Number x, const ShockCurve& curve, double gamma0,
                                                        double a) {
  ShockCurve::Derivatives<Number> hugoniot = curve.pressure(x);
  if (const auto tension = x < Number{}; any(tension)) {
    const ShockCurve::Derivatives<Number> linear = ShockCurve{curve.slope}.pressure(x);
    hugoniot = {select(tension, linear.value, hugoniot.value), select(tension, linear.slope, hugoniot.slope),
                select(tension, linear.curvature, hugoniot.curvature)};
  }
  const Number n = x * (gamma0 - a * x), n1 = gamma0 - 2 * a * x;
  const double n2 = -2 * a;
  const Number w = 1 / (1 - x);
  const Number f = 1 - 0.5 * n * w;
  const Number f1 = -0.5 * w * (n1 + n * w);
  const Number f2 = -0.5 * w * (n2 + 2 * w * (n1 + n * w));
  return {hugoniot.value * f, hugoniot.slope * f + hugoniot.value * f1,
          hugoniot.curvature * f + 2 * hugoniot.slope * f1 + hugoniot.value * f2};
}

}  // namespace whipple::eos

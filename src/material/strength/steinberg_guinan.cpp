// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/strength/steinberg_guinan.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "src/core/base/simd.hpp"
#include "src/core/base/vector_math.hpp"

namespace whipple::strength {

/// Newton's method from the tangent at x = 0, which for decreasing hardening is below the root, inside a bracket. A
/// step of less than 1e-7 x is the last one, since the next error is proportional to its square.
WHIPPLE_KERNEL void SteinbergGuinan::solve(YieldingPoints& points, double) const {
  const std::size_t n = points.size;
  const double slope_of_base = hardening_exponent * hardening_coefficient;
  BatchValues base, flow, slope, ratio, stiffness, lower, upper;
  std::array<std::uint64_t, batch_size> active;
  // Flow stress at the strains of the end of the step, and its slope
  const auto harden = [&] {
    for (std::size_t k = 0; k < n; ++k) {
      const double strain = points.plastic_strain[k] + points.increment[k] + initial_plastic_strain;
      flow[k] = base[k] = 1.0 + hardening_coefficient * strain;
    }
    logarithms(flow.data(), n);
    for (std::size_t k = 0; k < n; ++k) flow[k] *= hardening_exponent;
    exponentials(flow.data(), n);
    for (std::size_t k = 0; k < n; ++k) {
      const double power = yield_stress * flow[k];
      const bool bounded = power >= maximum_flow_stress;
      flow[k] = ratio[k] * (bounded ? maximum_flow_stress : power);
      slope[k] = bounded ? 0.0 : ratio[k] * (slope_of_base * power / base[k]);
    }
  };
  for (std::size_t k = 0; k < n; ++k) {
    ratio[k] = points.modulus[k] / shear_modulus;  // G/G0, including w
    stiffness[k] = 3.0 * points.modulus[k];
    points.increment[k] = lower[k] = 0.0;
  }
  harden();
  std::uint64_t any = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double excess = points.trial[k] - flow[k];
    active[k] = excess > 0.0 ? 1 : 0;
    upper[k] = excess / stiffness[k];
    points.increment[k] = excess > 0.0 ? excess / (stiffness[k] + slope[k]) : 0.0;
    any |= active[k];
  }
  for (int iteration = 0; iteration < 60 && any != 0; ++iteration) {
    harden();
    any = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double x = points.increment[k];
      const double residual = points.trial[k] - stiffness[k] * x - flow[k];
      const bool open = active[k] != 0 && std::abs(residual) > 1e-12 * points.trial[k];
      lower[k] = open && residual > 0.0 ? x : lower[k];
      upper[k] = open && !(residual > 0.0) ? x : upper[k];
      const double newton = x + residual / (stiffness[k] + slope[k]);
      const bool inside = newton > lower[k] && newton < upper[k];
      points.increment[k] = open ? (inside ? newton : 0.5 * (lower[k] + upper[k])) : x;
      const bool last = inside && std::abs(residual) <= 1e-7 * stiffness[k] * points.increment[k];
      active[k] = open && !last && upper[k] - lower[k] > 1e-15 * upper[k] ? 1 : 0;
      any |= active[k];
    }
  }
}

}  // namespace whipple::strength

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"

namespace whipple::md {

/// Holds the densities of a melt and its vapour at one temperature.
struct Saturation {
  double temperature = 0.0;  ///< K
  Estimate liquid_density;   ///< kg/m^3
  Estimate vapour_density;   ///< kg/m^3
};

struct CriticalPoint {
  Estimate temperature;  ///< K
  Estimate density;      ///< kg/m^3
};

/// Estimates the critical point from densities below it: the difference follows the scaling law rho_l - rho_v = A
/// (1 - T/Tc)^0.325, the mean is a straight line (rectilinear diameters; docs/theory/molecular_dynamics.md,
/// equations 16 and 17). Errors are propagated from those of the densities.
/// @throws StateError for fewer than three temperatures, or if the densities do not approach each other.
CriticalPoint estimate_critical_point(std::span<const Saturation> points);

/// Returns the finished points of the protocol liquid_vapour.
std::vector<Saturation> saturations(std::span<const PointRecord> points);

}  // namespace whipple::md

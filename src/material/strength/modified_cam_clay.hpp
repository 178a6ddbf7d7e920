// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/strength/brittle.hpp"

namespace whipple::strength {

/// Modified Cam-clay, soft soil that compacts and hardens or dilates and softens: an ellipse in q and p whose length p_c
/// follows the plastic volume ratio J_p, with associated flow,
///   f = q^2/M^2 + p (p - p_c) <= 0,   p_c = p_c0 J_p^(-1/h),   dep = 2 q x/M^2,   d(ln J_p) = -(2 p - p_c) x.
/// Source: K. H. Roscoe, J. B. Burland, Engineering Plasticity (Cambridge, 1968) 535. docs/theory/soil.md, section 6.
struct ModifiedCamClay : ElasticConstants {
  double critical_state_slope = 0.0;       ///< M
  double preconsolidation_pressure = 0.0;  ///< p_c0, Pa
  double plastic_compressibility = 0.0;    ///< h
  double maximum_dilation = 0.2;           ///< of ln J_p

  static ParameterTable<ModifiedCamClay> parameters();
  static constexpr bool keeps_strength = true;
  static constexpr const char* name = "modified_cam_clay";
  static constexpr const char* summary = "soft soil that hardens by compaction (modified Cam-clay)";
  static constexpr const char* theory =
      "q^2/M^2 + p (p - p_c) <= 0, p_c = p_c0 J_p^(-1/h), associated flow; J_p, the plastic volume ratio, is "
      "1 at the "
      "start.\n"
      "The equation of state is that of elastic compression; a gap opens at p = 0.\n"
      "Source: Roscoe and Burland, Engineering Plasticity (Cambridge, 1968) 535.";

  void require_consistent() const {}  // ensured by the ranges of the constants
  [[nodiscard]] bool changes_volume() const { return true; }
  static double least_pressure(const BrittlePoint&) { return 0.0; }
  static double crushed_strain(const BrittlePoint&) { return 0.0; }
  /// Returns p_c, Pa.
  [[nodiscard]] double length(double plastic_volume_ratio) const {
    return preconsolidation_pressure * std::pow(plastic_volume_ratio, -1.0 / plastic_compressibility);
  }
  [[nodiscard]] BrittleSurface surface(const BrittlePoint& point) const {
    const double p = std::max(point.pressure, 0.0);
    return {.whole = critical_state_slope * std::sqrt(std::max(0.0, p * (length(point.distension) - p))),
            .fall = 0.0,
            .greatest = std::numeric_limits<double>::infinity(),
            .failure_strain = std::numeric_limits<double>::infinity()};
  }
  /// Returns the growth of ln J_p by the return to the ellipse, in one unknown x (docs/theory/soil.md, eq. 14).
  [[nodiscard]] double growth(const DilatingPoint& point) const;
};

using ModifiedCamClayModel = BrittleModel<ModifiedCamClay>;

}  // namespace whipple::strength

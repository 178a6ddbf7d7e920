// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "src/core/base/words.hpp"
#include "src/material/strength/brittle.hpp"
#include "src/material/strength/dilatant.hpp"
#include "src/material/strength/return_slopes.hpp"

namespace whipple::strength {

/// The states in which a cone has the strength of the Mohr-Coulomb pyramid with the same constants.
enum class MatchedStates : std::uint8_t { compression, extension, plane_strain_associated, plane_strain };

constexpr std::array<Word<MatchedStates>, 4> words(MatchedStates) {
  return {{{MatchedStates::compression, "compression"},
           {MatchedStates::extension, "extension"},
           {MatchedStates::plane_strain_associated, "plane_strain_associated"},
           {MatchedStates::plane_strain, "plane_strain"}}};
}

/// Drucker-Prager, soil: a cone around the axis of hydrostatic pressure,
///   q <= min(d + M p, Y_max),   p >= p_min = -min(sigma_t, d/M),   d(ln J_p) = M_psi dep on the cone, 0 on Y_max.
/// Source: D. C. Drucker, W. Prager, Q. Appl. Math. 10 (1952) 157. docs/theory/soil.md, sections 1 and 3.
struct DruckerPrager : Dilatant {
  MatchedStates match = MatchedStates::plane_strain;
  double maximum_strength = std::numeric_limits<double>::infinity();  ///< Y_max, Pa

  struct Cone {
    double slope;     ///< M
    double cohesion;  ///< d, Pa
  };
  Cone prepared{0.0, 0.0};         ///< cone() of the constants, by prepare()
  double prepared_dilation = 0.0;  ///< M_psi at the start, by prepare()

  static ParameterTable<DruckerPrager> parameters() {
    using P = DruckerPrager;
    return Dilatant::parameters<P>(
        {choice("match", &P::match, "states in which the cone has the strength of Mohr and Coulomb"),
         real("maximum_strength", &P::maximum_strength, "Pa", range::positive(), "Y_max").optional()},
        "the apex of the cone");
  }
  static constexpr bool keeps_strength = true;
  static constexpr const char* name = "drucker_prager";
  static constexpr const char* summary = "soil: friction, cohesion and dilation on a cone (Drucker-Prager)";
  static constexpr const char* theory =
      "q <= min(d + M p, Y_max), p >= -min(sigma_t, d/M): a gap opens. M and d from phi and c: "
      "compression 6 sin/(3 - sin), 6 c cos/(3 - sin); extension with 3 + sin;\n"
      "plane_strain_associated sqrt3 (3 tan, 3 c)/sqrt(9 + 12 tan^2); plane_strain sqrt3 (sin, c cos), the "
      "one of flow without dilation.\n"
      "Flow changes the plastic volume ratio J_p by d(ln J_p) = M_psi (1 - ln J_p/maximum_dilation) dep, "
      "M_psi from psi as M from phi, in plane strain 3 sin/sqrt(3 + sin^2).\n"
      "Source: Drucker and Prager, Q. Appl. Math. 10 (1952) 157.";

  /// Returns the cone in q and p that matches the Mohr-Coulomb pyramid (docs/theory/soil.md, eq. 2).
  [[nodiscard]] Cone cone() const {
    const double sine = std::sin(friction_angle), cosine = std::cos(friction_angle), tangent = sine / cosine;
    const double root = std::numbers::sqrt3;
    switch (match) {
      case MatchedStates::compression:
        return {6.0 * sine / (3.0 - sine), 6.0 * cohesion * cosine / (3.0 - sine)};
      case MatchedStates::extension:
        return {6.0 * sine / (3.0 + sine), 6.0 * cohesion * cosine / (3.0 + sine)};
      case MatchedStates::plane_strain_associated: {
        const double length = std::sqrt(9.0 + 12.0 * tangent * tangent);
        return {3.0 * root * tangent / length, 3.0 * root * cohesion / length};
      }
      case MatchedStates::plane_strain:
        break;
    }
    return {root * sine, root * cohesion * cosine};
  }

  /// Returns M_psi of the dilation angle: the flow of the pyramid in the states that `match` names (docs/theory/soil.md,
  /// eq. 7).
  [[nodiscard]] double dilation_slope() const {
    const double sine = std::sin(dilation_angle);
    switch (match) {
      case MatchedStates::compression:
        return 6.0 * sine / (3.0 - sine);
      case MatchedStates::extension:
        return 6.0 * sine / (3.0 + sine);
      case MatchedStates::plane_strain_associated:
      case MatchedStates::plane_strain:
        break;
    }
    return 3.0 * sine / std::sqrt(3.0 + sine * sine);
  }
  void prepare() {
    prepared = cone();
    prepared_dilation = dilation_slope();
  }
  [[nodiscard]] double least_pressure(const BrittlePoint&) const {
    return -std::min(tensile_strength, prepared.cohesion / prepared.slope);
  }
  static double crushed_strain(const BrittlePoint&) { return 0.0; }
  [[nodiscard]] BrittleSurface surface(const BrittlePoint& point) const {
    return {.whole = prepared.cohesion + prepared.slope * point.pressure,
            .fall = 0.0,
            .greatest = maximum_strength,
            .failure_strain = std::numeric_limits<double>::infinity()};
  }
  /// Returns the growth of ln J_p by the return to the cone, not beyond the pressure at which Y_max is reached
  /// (docs/theory/soil.md, eq. 8).
  [[nodiscard]] double growth(const DilatingPoint& point) const {
    const double slope = prepared.slope, psi = prepared_dilation * remaining(point.distension);
    const double excess = point.trial - prepared.cohesion - slope * point.pressure;
    const double end = (maximum_strength - prepared.cohesion) / slope;  // of the cone, Pa
    if (!(excess > 0.0) || !(point.pressure < end)) return 0.0;
    const double increment = excess / (3.0 * point.modulus + point.stiffness * slope * psi);
    return std::min({psi * increment, room(point.distension), (end - point.pressure) / point.stiffness});
  }
  /// Returns M on the cone and 0 on Y_max, and the slopes of the growth of (8) of docs/theory/soil.md.
  [[nodiscard]] ReturnSlopes slopes(const ReturnedPoint& point) const {
    if (!point.flows) return {};
    const double slope = prepared.slope, psi = prepared_dilation * remaining(point.distension);
    const bool on_cone = prepared.cohesion + slope * point.pressure < maximum_strength;
    ReturnSlopes out{.stress_by_trial = 0.0, .stress_by_pressure = on_cone ? slope : 0.0};
    if (!(point.growth > 0.0)) return out;
    const double end = (maximum_strength - prepared.cohesion) / slope;
    const double before = point.pressure - point.stiffness * point.growth;  // pressure without the growth
    const double resistance = 3.0 * point.modulus + point.stiffness * slope * psi;
    const double by_flow = psi * (point.trial - prepared.cohesion - slope * before) / resistance;
    const double to_end = (end - before) / point.stiffness;
    if (by_flow <= room(point.distension) && by_flow <= to_end) {
      out.growth_by_trial = psi / resistance;
      out.growth_by_pressure = -slope * psi / resistance;
    } else if (to_end <= room(point.distension)) {
      out.growth_by_pressure = -1.0 / point.stiffness;
    }
    return out;
  }
};

using DruckerPragerModel = BrittleModel<DruckerPrager>;

}  // namespace whipple::strength

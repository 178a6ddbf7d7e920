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

namespace whipple::strength {

/// The states in which a cone has the strength of the Mohr-Coulomb pyramid with the same constants.
enum class MatchedStates : std::uint8_t { compression, extension, plane_strain_associated, plane_strain };

constexpr std::array<Word<MatchedStates>, 4> words(MatchedStates) {
  return {{{MatchedStates::compression, "compression"},
           {MatchedStates::extension, "extension"},
           {MatchedStates::plane_strain_associated, "plane_strain_associated"},
           {MatchedStates::plane_strain, "plane_strain"}}};
}

/// Drucker-Prager, soil: a cone around the axis of hydrostatic pressure that flows without dilation,
///   q <= min(d + M p, Y_max),   p >= p_min = -min(sigma_t, d/M).
/// Source: D. C. Drucker, W. Prager, Q. Appl. Math. 10 (1952) 157. docs/theory/soil.md, section 1.
struct DruckerPrager : ElasticConstants {
  double friction_angle = 0.0;  ///< phi, rad
  double cohesion = 0.0;        ///< c, Pa
  MatchedStates match = MatchedStates::plane_strain;
  double tensile_strength = std::numeric_limits<double>::infinity();  ///< sigma_t, Pa
  double maximum_strength = std::numeric_limits<double>::infinity();  ///< Y_max, Pa

  struct Cone {
    double slope;     ///< M
    double cohesion;  ///< d, Pa
  };
  Cone prepared{0.0, 0.0};  ///< cone() of the constants, by prepare()

  static ParameterTable<DruckerPrager> parameters() {
    using P = DruckerPrager;
    return ElasticConstants::parameters<P>(
        {real("friction_angle", &P::friction_angle, "rad", range::open_between(0.0, std::numbers::pi / 2),
              "phi, angle of internal friction"),
         real("cohesion", &P::cohesion, "Pa", range::non_negative(), "c"),
         choice("match", &P::match, "states in which the cone has the strength of Mohr and Coulomb"),
         real("tensile_strength", &P::tensile_strength, "Pa", range::non_negative(),
              "sigma_t: mean tension at which gaps open, if that is less than the apex of the cone")
             .optional("the apex of the cone"),
         real("maximum_strength", &P::maximum_strength, "Pa", range::positive(), "Y_max").optional()});
  }
  static constexpr bool keeps_strength = true;
  static constexpr const char* name = "drucker_prager";
  static constexpr const char* summary = "soil: friction and cohesion without dilation (Drucker-Prager)";
  static constexpr const char* theory =
      "q <= min(d + M p, Y_max), p >= -min(sigma_t, d/M): a gap opens. M and d from phi and c: "
      "compression 6 sin/(3 - sin), 6 c cos/(3 - sin); extension with 3 + sin;\n"
      "plane_strain_associated sqrt3 (3 tan, 3 c)/sqrt(9 + 12 tan^2); plane_strain sqrt3 (sin, c cos), the "
      "one of flow without dilation.\n"
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

  void require_consistent() const {}  // ensured by the ranges of the constants
  void prepare() { prepared = cone(); }
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
};

using DruckerPragerModel = BrittleModel<DruckerPrager>;

}  // namespace whipple::strength

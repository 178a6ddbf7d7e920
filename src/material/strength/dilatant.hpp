// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/elastic_constants.hpp"

namespace whipple::strength {

/// Holds the constants of soil with friction, cohesion and dilation: as it flows its plastic volume ratio J_p grows, by
/// an angle that falls as ln J_p does from 1 to its greatest value (docs/theory/soil.md, section 3).
struct Dilatant : ElasticConstants {
  double friction_angle = 0.0;                                        ///< phi, rad
  double cohesion = 0.0;                                              ///< c, Pa
  double tensile_strength = std::numeric_limits<double>::infinity();  ///< sigma_t, Pa
  double dilation_angle = 0.0;                                        ///< psi, rad
  double maximum_dilation = 0.05;                                     ///< of ln J_p

  /// Returns the table of a law that derives from this struct: these constants, with those of the law between cohesion
  /// and tensile strength.
  /// @param apex  what ends the surface in tension
  template <class Owner>
  static ParameterTable<Owner> parameters(const ParameterTable<Owner>& own, const std::string& apex) {
    ParameterTable<Owner> table = {
        real<Owner>("friction_angle", &Owner::friction_angle, "rad",
                    range::open_between(0.0, std::numbers::pi / 2), "phi, angle of internal friction"),
        real<Owner>("cohesion", &Owner::cohesion, "Pa", range::non_negative(), "c")};
    table.append(own);
    table.append({real<Owner>("tensile_strength", &Owner::tensile_strength, "Pa", range::non_negative(),
                              "sigma_t: mean tension at which gaps open, if that is less than " + apex)
                      .optional(apex),
                  real<Owner>("dilation_angle", &Owner::dilation_angle, "rad",
                              Range{.lower = 0.0, .upper = std::numbers::pi / 2, .upper_open = true},
                              "psi at the start, not above phi; 0: the volume does not change by flow")
                      .optional(),
                  real<Owner>("maximum_dilation", &Owner::maximum_dilation, "",
                              Range{.lower = 0.0, .upper = 0.5, .lower_open = true},
                              "ln of the plastic volume ratio at which dilation has ended")
                      .optional()});
    return ElasticConstants::parameters<Owner>(table);
  }

  /// @throws InputError if the soil dilates more than its friction allows
  void require_consistent() const {
    if (dilation_angle <= friction_angle) return;
    constexpr double degree = std::numbers::pi / 180.0;
    throw InputError(
        fmt::format("'dilation_angle' {:.6g} deg must not be above 'friction_angle' {:.6g} deg: flow would "
                    "give work back",
                    dilation_angle / degree, friction_angle / degree));
  }
  [[nodiscard]] bool changes_volume() const { return dilation_angle > 0.0; }
  /// Returns how much ln J_p may still grow.
  [[nodiscard]] double room(double plastic_volume_ratio) const {
    return std::max(0.0, maximum_dilation - std::log(plastic_volume_ratio));
  }
  /// Returns the fraction of the dilation that is left.
  [[nodiscard]] double remaining(double plastic_volume_ratio) const {
    return room(plastic_volume_ratio) / maximum_dilation;
  }
};

}  // namespace whipple::strength

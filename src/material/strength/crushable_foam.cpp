// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/strength/crushable_foam.hpp"

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/material/strength/decreasing_root.hpp"

namespace whipple::strength {

ParameterTable<CrushableFoam> CrushableFoam::parameters() {
  using P = CrushableFoam;
  return ElasticConstants::parameters<P>(
      {real("relative_density", &P::relative_density, "",
            Range{.lower = 0.0, .upper = 1.0, .lower_open = true, .upper_open = true},
            "density of the foam over that of its solid"),
       real("hydrostatic_yield", &P::hydrostatic_yield, "Pa", range::positive(),
            "p_0, pressure at which the foam as it is made is crushed from all sides"),
       real("uniaxial_yield", &P::uniaxial_yield, "Pa", range::positive(),
            "sigma_c of the foam as it is made, without lateral stress; below 3 p_0"),
       real("tensile_yield", &P::tensile_yield, "Pa", range::non_negative(),
            "p_t, tension from all sides at which foam flows; at most p_0")
           .optional(),
       real("linear_hardening", &P::linear_hardening, "Pa", range::non_negative(), "h").optional(),
       real("densification_stress", &P::densification_stress, "Pa", range::non_negative(), "b").optional(),
       real("densification_exponent", &P::densification_exponent, "", range::positive(), "m").optional(),
       real("solid_yield_stress", &P::solid_yield_stress, "Pa", range::positive(),
            "flow stress of the solid where the pores are closed")});
}

double CrushableFoam::shape() const {
  const double k = uniaxial_yield / hydrostatic_yield, tensile = tensile_yield / hydrostatic_yield;
  return 9.0 * k * k / ((3.0 * tensile + k) * (3.0 - k));
}

double CrushableFoam::strength_at(double distension) const {
  constexpr double last = 1.0 - 1e-6;
  const double z = std::clamp(1.0 + std::log(distension) / std::log(relative_density), 0.0, last);
  return hydrostatic_yield + linear_hardening * z -
         densification_stress * std::log1p(-std::pow(z, densification_exponent));
}

CrushableFoamModel::CrushableFoamModel(const CrushableFoam& law) : FoamModel(law), shape_(law.shape()) {
  if (!(law.uniaxial_yield < 3.0 * law.hydrostatic_yield)) {
    throw InputError("'uniaxial_yield' must be below three times 'hydrostatic_yield'");
  }
  if (law.tensile_yield > law.hydrostatic_yield) {
    throw InputError("'tensile_yield' must not exceed 'hydrostatic_yield'");
  }
}

void CrushableFoamModel::flow_stress(const State&, std::span<const double>, std::span<double> stress) const {
  std::ranges::fill(stress, law_.uniaxial_yield);
}

void CrushableFoamModel::crush(const FoamState& state) const {
  crush_points(state, [&](std::size_t i) { flow(state, i); });
}

/// Returns the point to the ellipse in one unknown, the compaction v = -d(ln distension) (foam.md, eq. 7):
///   p = p_t - K v,  q = q_t/(1 + 6 G x),  x = v/[a^2 (2 p - p_c + p_t)],
/// where v has the sign of its normal; not beyond the closing of the pores. A step that dilates keeps its p_c.
void CrushableFoamModel::flow(const FoamState& state, std::size_t i) const {
  const double trial = state.trial[i], pressure = state.pressure[i], bulk = state.bulk_modulus[i];
  const double before = state.distension[i], tension = law_.tensile_yield, shear = 6.0 * state.modulus[i];
  state.equivalent[i] = trial;
  state.plastic_increment[i] = 0.0;
  state.dissipation[i] = 0.0;
  const double at_start = law_.strength_at(before);
  const double excess = trial * trial + shape_ * (pressure - at_start) * (pressure + tension);
  if (!(excess > 0.0)) return;

  const double normal = 2.0 * pressure - at_start + tension, direction = normal < 0.0 ? -1.0 : 1.0;
  const auto crush_pressure = [&](double v) {
    return direction > 0.0 ? law_.strength_at(before * std::exp(-v)) : at_start;
  };
  const auto deviator = [&](double v, double limit) {
    const double slope = shape_ * direction * (2.0 * (pressure - bulk * direction * v) - limit + tension);
    return slope > 0.0 ? trial / (1.0 + shear * v / slope) : 0.0;
  };
  // v is counted along the normal. Where the normal vanishes q does, and the point is inside.
  double v = decreasing_root(excess, std::abs(normal) / (2.0 * bulk) * (1.0 + 1e-12), [&](double v) {
    const double limit = crush_pressure(v), p = pressure - bulk * direction * v, q = deviator(v, limit);
    return q * q + shape_ * (p - limit) * (p + tension);
  });
  const double room = std::log(std::max(before, 1.0));
  double p = pressure - bulk * direction * v, q = 0.0;
  if (direction > 0.0 && v > room) {  // the solid takes the rest
    v = room;
    const double limit = crush_pressure(v);
    q = deviator(v, limit);
    p = std::min(pressure - bulk * v, limit);
  } else {  // on the surface, also where v is too small to tell q
    q = std::sqrt(std::max(0.0, shape_ * (crush_pressure(v) - p) * (p + tension)));
    q = std::min(q, trial);
  }
  const double sheared = shear > 0.0 ? 2.0 * (trial - q) / shear : 0.0;
  const double increment = std::sqrt(sheared * sheared + 2.0 / 9.0 * v * v);
  state.equivalent[i] = q;
  state.plastic_increment[i] = increment;
  state.plastic_strain[i] += increment;
  state.distension[i] = std::max(1.0, before * std::exp(-direction * v));
  state.dissipation[i] = std::max(0.0, q * sheared + p * direction * v);
}

}  // namespace whipple::strength

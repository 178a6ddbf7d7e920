// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/strength/deshpande_fleck.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/material/strength/decreasing_root.hpp"

namespace whipple::strength {
namespace {

constexpr double last = 1.0 - 1e-6;  ///< greatest z of the hardening curve

}  // namespace

ParameterTable<DeshpandeFleck> DeshpandeFleck::parameters() {
  using P = DeshpandeFleck;
  return ElasticConstants::parameters<P>(
      {real("relative_density", &P::relative_density, "",
            Range{.lower = 0.0, .upper = 1.0, .lower_open = true, .upper_open = true},
            "density of the foam over that of its solid"),
       real("plateau_stress", &P::plateau_stress, "Pa", range::positive(), "sigma_p"),
       real("linear_hardening", &P::linear_hardening, "Pa", range::non_negative(), "gamma").optional(),
       real("densification_stress", &P::densification_stress, "Pa", range::non_negative(), "alpha_2")
           .optional(),
       real("densification_exponent", &P::densification_exponent, "", range::positive(), "beta").optional(),
       real("plastic_poisson_ratio", &P::plastic_poisson_ratio, "",
            Range{.lower = -1.0, .upper = 0.5, .lower_open = true, .upper_open = true},
            "nu_p, contraction of a bar that is crushed along its axis")
           .optional(),
       real("solid_yield_stress", &P::solid_yield_stress, "Pa", range::positive(),
            "flow stress of the solid where the pores are closed")});
}

double DeshpandeFleck::densification_strain() const {
  return (9.0 + shape()) / (3.0 * shape()) * std::log(1.0 / relative_density);
}

double DeshpandeFleck::strength_at(double strain) const {
  const double z = std::min(strain / densification_strain(), last);
  return plateau_stress + linear_hardening * z -
         densification_stress * std::log1p(-std::pow(z, densification_exponent));
}

DeshpandeFleckModel::DeshpandeFleckModel(const DeshpandeFleck& law) : FoamModel(law) {}

void DeshpandeFleckModel::flow_stress(const State& state, std::span<const double>,
                                      std::span<double> stress) const {
  for (std::size_t i = 0; i < stress.size(); ++i) stress[i] = law_.strength_at(state.plastic_strain[i]);
}

void DeshpandeFleckModel::crush(const FoamState& state) const {
  crush_points(state, [&](std::size_t i) { flow(state, i); });
}

/// Returns the point to the ellipse in one unknown, the increment x of the equivalent plastic strain (foam.md, eq. 3),
///   q = q_t/(1 + 3 G x/(A Y)),  p = p_t/(1 + K a^2 x/(A Y)),  d(ln distension) = -x a^2 p/(A Y),
/// but not beyond the closing of the pores.
void DeshpandeFleckModel::flow(const FoamState& state, std::size_t i) const {
  const double square = law_.shape(), a = 1.0 + square / 9.0, shear = 3.0 * state.modulus[i];
  const double bulk = square * state.bulk_modulus[i], trial = state.trial[i], pressure = state.pressure[i];
  const double before = state.plastic_strain[i];
  state.equivalent[i] = trial;
  state.plastic_increment[i] = 0.0;
  state.dissipation[i] = 0.0;
  const auto returned = [&](double x, double y) {
    return std::pair(trial / (1.0 + shear * x / (a * y)), pressure / (1.0 + bulk * x / (a * y)));
  };
  const auto excess = [&](double x) {
    const double y = law_.strength_at(before + x);
    const auto [q, p] = returned(x, y);
    return std::sqrt((q * q + square * p * p) / a) - y;
  };
  const double at_zero = excess(0.0);
  if (!(at_zero > 0.0)) return;
  // Both moduli at least: the stress is on the surface before this increment.
  const double softest = state.modulus[i] > 0.0 && trial > 0.0 ? std::min(shear, bulk) : bulk;
  double x = decreasing_root(at_zero, a * at_zero / softest * (1.0 + 1e-12), excess);
  double y = law_.strength_at(before + x);
  auto [q, p] = returned(x, y);
  double compaction = x * square * p / (a * y);
  const double room = std::log(std::max(state.distension[i], 1.0));
  if (compaction > room) {  // the solid takes the rest
    x *= room / compaction;
    y = law_.strength_at(before + x);
    q = returned(x, y).first;
    compaction = room;
  }
  state.equivalent[i] = q;
  state.plastic_increment[i] = x;
  state.plastic_strain[i] += x;
  state.distension[i] = std::max(1.0, state.distension[i] * std::exp(-compaction));
  state.dissipation[i] = y * x;
}

}  // namespace whipple::strength

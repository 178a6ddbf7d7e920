// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md.
#include "eos/models/jwl_reactant.hpp"

#include <fmt/core.h>

#include <cmath>

#include "eos/constant_heat_capacity_batch.hpp"

namespace whipple::eos {

template class ConstantHeatCapacity<JwlReactantCurve>;

namespace {

// The pressure at rest is the sum of two large terms that nearly cancel and a small one: one wrong digit shifts T0 by
// thousands of kelvins.
constexpr double coldest_rest = 200.0, hottest_rest = 400.0;  // K

}  // namespace

ParameterTable<JwlReactantConstants> JwlReactantCurve::parameters() {
  using C = JwlReactantConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(), "rho0 of the explosive"),
      real("pressure_1", &C::pressure_1, "Pa", range::positive(), "A"),
      real("pressure_2", &C::pressure_2, "Pa", range::any(), "B, negative: cohesion"),
      real("exponent_1", &C::exponent_1, "", range::positive(), "R1, of exp(-R1 rho0/rho)"),
      real("exponent_2", &C::exponent_2, "", range::positive(), "R2"),
      real("gruneisen", &C::gruneisen, "", range::positive(), "omega, Grueneisen parameter"),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(), "c_v, constant"),
  };
}

JwlReactantCurve::JwlReactantCurve(const Constants& constants) : constants_(constants) {
  const Constants& k = constants_;
  const double p1 = k.pressure_1 * std::exp(-k.exponent_1), p2 = k.pressure_2 * std::exp(-k.exponent_2);
  reference_temperature_ = -(p1 + p2) / (k.gruneisen * k.heat_capacity * k.reference_density);
  if (!(reference_temperature_ >= coldest_rest && reference_temperature_ <= hottest_rest)) {
    throw InputError(fmt::format(
        "jwl_reactant: the explosive at rest has no pressure at {:.4g} K, which is not between {:.4g} and "
        "{:.4g} K; check the constants",
        reference_temperature_, coldest_rest, hottest_rest));
  }
  rest_energy_ = (p1 / k.exponent_1 + p2 / k.exponent_2) / k.reference_density +
                 k.heat_capacity * reference_temperature_;
  const double squared =
      isochore(broadcast(k.reference_density)).response(broadcast(0.0)).squared_sound_speed[0];
  if (!(squared > 0.0))
    throw InputError("jwl_reactant: the explosive at rest has no sound speed; check the constants");
  reference_sound_speed_ = std::sqrt(squared);
}

double JwlReactantCurve::log_isentrope_temperature(double rho) const {
  return constants_.gruneisen * std::log(rho / reference_density());
}

}  // namespace whipple::eos

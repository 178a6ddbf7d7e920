// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/tait.hpp"

#include "eos/constant_heat_capacity_batch.hpp"

namespace whipple::eos {

template class ConstantHeatCapacity<TaitCurve>;

ParameterTable<TaitConstants> TaitCurve::parameters() {
  using C = TaitConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(),
           "rho0, density at the reference temperature and zero pressure"),
      real("sound_speed", &C::sound_speed, "m/s", range::positive(), "c0 of the reference state"),
      real("exponent", &C::exponent, "", {.lower = 1.0, .lower_open = true},
           "n of p = rho0 c0^2/n [(rho/rho0)^n - 1]"),
      real("gruneisen", &C::gruneisen, "", range::non_negative(), "Grueneisen parameter, constant"),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(), "c_v, constant"),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(), "T0").optional(),
  };
}

TaitCurve::TaitCurve(const Constants& k)
    : PowerIsentropeCurve(k, k.reference_density * k.sound_speed * k.sound_speed, k.exponent) {}

}  // namespace whipple::eos

// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/murnaghan.hpp"

#include "eos/constant_heat_capacity_batch.hpp"

namespace whipple::eos {

template class ConstantHeatCapacity<MurnaghanCurve>;

ParameterTable<MurnaghanConstants> MurnaghanCurve::parameters() {
  using C = MurnaghanConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(),
           "rho0, density at the reference temperature and zero pressure"),
      real("bulk_modulus", &C::bulk_modulus, "Pa", range::positive(), "K0 at constant entropy, rho0 c0^2"),
      real("bulk_modulus_slope", &C::bulk_modulus_slope, "", {.lower = 1.0, .lower_open = true},
           "K0' = dK/dp at constant entropy"),
      real("gruneisen", &C::gruneisen, "", range::non_negative(), "Grueneisen parameter, constant"),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(), "c_v, constant"),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(), "T0").optional(),
  };
}

MurnaghanCurve::MurnaghanCurve(const Constants& k)
    : PowerIsentropeCurve(k, k.bulk_modulus, k.bulk_modulus_slope) {}

}  // namespace whipple::eos

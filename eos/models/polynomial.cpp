// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/polynomial.hpp"

#include <cmath>

#include "eos/constant_heat_capacity_batch.hpp"

namespace whipple::eos {

template class ConstantHeatCapacity<PolynomialCurve>;

ParameterTable<PolynomialConstants> PolynomialCurve::parameters() {
  using C = PolynomialConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(), "rho0"),
      real("C0", &C::C0, "Pa", range::any(), "pressure at rho0 and zero energy").optional(),
      real("C1", &C::C1, "Pa", range::non_negative(), "factor of mu = rho/rho0 - 1, also in expansion"),
      real("C2", &C::C2, "Pa", range::any(), "factor of mu^2, in compression").optional(),
      real("C3", &C::C3, "Pa", range::any(), "factor of mu^3, in compression").optional(),
      real("C4", &C::C4, "", range::non_negative(),
           "factor of rho0 e in compression; Grueneisen parameter in expansion"),
      real("C5", &C::C5, "", range::any(), "factor of mu rho0 e, in compression").optional(),
      real("C6", &C::C6, "", range::any(), "factor of mu^2 rho0 e, in compression").optional(),
      real("reference_energy", &C::reference_energy, "J/kg", range::any(), "e at rho0 and T0").optional(),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(), "c_v, constant"),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(), "T0").optional(),
  };
}

GruneisenSolid<PolynomialCurve::Polynomial> PolynomialCurve::solid(const Constants& k) {
  return {name,
          {k.C0, k.C1, k.C2, k.C3},
          {k.C4, k.C5, k.C6},
          {k.reference_density, k.reference_temperature, k.reference_energy, k.heat_capacity},
          k.C0,
          k.C1,
          1 - 1 / greatest_compression_ratio};
}

PolynomialCurve::PolynomialCurve(const Constants& k)
    // c^2 of the reference state on the expansion side.
    : constants_(k),
      reference_sound_speed_(
          std::sqrt((k.C1 + k.C4 * k.C0) / k.reference_density + k.C4 * (1 + k.C4) * k.reference_energy)),
      solid_(solid(k)) {
  if (!(reference_sound_speed_ > 0)) {
    throw InputError(
        "polynomial: the reference state has no sound speed (c^2 <= 0); check C0, C1, C4 and "
        "reference_energy");
  }
}

}  // namespace whipple::eos

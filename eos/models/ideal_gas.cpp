// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/ideal_gas.hpp"

#include <cmath>

#include "eos/constant_heat_capacity_batch.hpp"

namespace whipple::eos {

template class ConstantHeatCapacity<IdealGasCurve>;

ParameterTable<IdealGasConstants> IdealGasCurve::parameters() {
  using C = IdealGasConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(),
           "rho0, density at the reference temperature"),
      real("heat_capacity_ratio", &C::heat_capacity_ratio, "", {.lower = 1.0, .lower_open = true}, "gamma"),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(), "c_v, constant"),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(), "T0").optional(),
  };
}

double IdealGasCurve::reference_sound_speed() const {
  const double gamma = constants_.heat_capacity_ratio;
  return std::sqrt(gamma * (gamma - 1) * reference_energy());
}

double IdealGasCurve::log_isentrope_temperature(double rho) const {
  return (constants_.heat_capacity_ratio - 1) * std::log(rho / constants_.reference_density);
}

}  // namespace whipple::eos

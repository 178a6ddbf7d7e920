// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/stiffened_gas.hpp"

#include <cmath>

#include "eos/constant_heat_capacity_batch.hpp"

namespace whipple::eos {

template class ConstantHeatCapacity<StiffenedGasCurve>;

ParameterTable<StiffenedGasConstants> StiffenedGasCurve::parameters() {
  using C = StiffenedGasConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(),
           "rho0, density at the reference temperature and pressure"),
      real("heat_capacity_ratio", &C::heat_capacity_ratio, "", {.lower = 1.0, .lower_open = true}, "gamma"),
      real("stiffness_pressure", &C::stiffness_pressure, "Pa", range::positive(), "p_inf"),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(), "c_v, constant"),
      real("reference_pressure", &C::reference_pressure, "Pa", range::non_negative(), "p0").optional(),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(), "T0").optional(),
  };
}

StiffenedGasCurve::StiffenedGasCurve(const Constants& k)
    : constants_(k),
      zero_(-(k.reference_pressure + k.heat_capacity_ratio * k.stiffness_pressure) /
            ((k.heat_capacity_ratio - 1) * k.reference_density)),
      excess_((k.reference_pressure + k.stiffness_pressure) /
                  ((k.heat_capacity_ratio - 1) * k.reference_density) -
              k.heat_capacity * k.reference_temperature) {}

double StiffenedGasCurve::reference_sound_speed() const {
  const Constants& k = constants_;
  return std::sqrt(k.heat_capacity_ratio * (k.reference_pressure + k.stiffness_pressure) /
                   k.reference_density);
}

double StiffenedGasCurve::log_isentrope_temperature(double rho) const {
  return (constants_.heat_capacity_ratio - 1) * std::log(rho / constants_.reference_density);
}

}  // namespace whipple::eos

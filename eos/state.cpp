// SPDX-License-Identifier: BSD-3-Clause
#include "eos/state.hpp"

namespace whipple::eos {

void derive(State& s) {
  s.isentropic_bulk_modulus = s.density * s.sound_speed * s.sound_speed;
  if (s.isothermal_bulk_modulus > 0) {
    s.thermal_expansion = s.gruneisen * s.density * s.heat_capacity / s.isothermal_bulk_modulus;
    s.isobaric_heat_capacity = s.heat_capacity * (1 + s.thermal_expansion * s.gruneisen * s.temperature);
  }
  s.helmholtz_energy = s.specific_internal_energy - s.temperature * s.specific_entropy;
  s.gibbs_energy = s.helmholtz_energy + s.pressure / s.density;
}

}  // namespace whipple::eos

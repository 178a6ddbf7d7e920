// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/laws.hpp"

#include <cmath>
#include <utility>

namespace whipple::fit {
namespace {
/// g_anh (V/V0)^gamma_e T^2/2 per mass
double anharmonic_energy(const eos::GrayConstants& c, double V, double T) {
  return c.anharmonic_heat_coefficient * std::pow(V / c.reference_specific_volume, c.electronic_gruneisen) *
         T * T / (2.0 * c.molar_mass);
}
}  // namespace

double gamma(const eos::GrayConstants& c, double V) {
  return c.gruneisen - c.gruneisen_slope * (1.0 - V / c.reference_specific_volume);
}

double thermal_energy(const eos::GrayConstants& c, double V, double T) {
  return 3.0 * eos::GrayConstants::gas_constant * T / c.molar_mass + anharmonic_energy(c, V, T);
}

double anharmonic_pressure(const eos::GrayConstants& c, double V, double T) {
  return (c.electronic_gruneisen - gamma(c, V)) * anharmonic_energy(c, V, T) / V;
}

double melting_temperature(const eos::GrayConstants& c, double V) {
  const double ratio = V / c.reference_specific_volume;
  return c.melting_temperature * std::pow(ratio, -2.0 * (c.gruneisen - 1.0 / 3.0 - c.gruneisen_slope)) *
         std::exp(2.0 * c.gruneisen_slope * (1.0 - ratio));
}

namespace {
/// The band rests on Delta S - alpha alone. Without the fall of the liquid's heat capacity (alpha = 0) the
/// surface exists for every g, also where liquid or vapour of the complete model would have no positive heat
/// capacity.
eos::GrayConstants without_liquid_slope(eos::GrayConstants constants) {
  constants.melting_entropy -= constants.liquid_heat_coefficient;
  constants.liquid_heat_coefficient = 0.0;
  return constants;
}
}  // namespace

Solidus::Solidus(eos::GrayConstants constants) : surface_(without_liquid_slope(std::move(constants))) {}

double Solidus::temperature(double V) const { return surface_.band(surface_.isochore(V)).T1; }

}  // namespace whipple::fit

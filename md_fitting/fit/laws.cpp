// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/laws.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {
/// Returns g_anh (V/V0)^gamma_e T^2/2 per unit mass.
double anharmonic_energy(const eos::GrayConstants& c, double V, double T) {
  return c.anharmonic_heat_coefficient * std::pow(V / c.reference_specific_volume, c.electronic_gruneisen) *
         T * T / (2.0 * c.molar_mass);
}

eos::GrayPoint phase(const eos::GrayFreeEnergy& surface, bool liquid, double V, double T) {
  return liquid ? surface.liquid(V, T) : surface.solid(V, T);
}
}  // namespace

double gamma(const eos::GrayConstants& c, double V) {
  return c.gruneisen - c.gruneisen_slope * (1.0 - V / c.reference_specific_volume);
}

double thermal_energy(const SolidConstants& c, double V, double T) {
  return c.heat_capacity * T + anharmonic_energy(c.gray, V, T);
}

double anharmonic_pressure(const eos::GrayConstants& c, double V, double T) {
  return (c.electronic_gruneisen - gamma(c, V)) * anharmonic_energy(c, V, T) / V;
}

double isotherm_pressure(const SolidConstants& c, double V) {
  const double X = std::cbrt(V / c.gray.reference_specific_volume);
  return 3.0 * c.bulk_modulus * (1.0 - X) / (X * X) *
         std::exp(1.5 * (c.bulk_modulus_slope - 1.0) * (1.0 - X));
}

double melting_temperature(const eos::GrayConstants& c, double V) {
  const double ratio = V / c.reference_specific_volume;
  return c.melting_temperature * std::pow(ratio, -2.0 * (c.gruneisen - 1.0 / 3.0 - c.gruneisen_slope)) *
         std::exp(2.0 * c.gruneisen_slope * (1.0 - ratio));
}

namespace {
/// Returns the constants used for melting. At one volume melting depends on Delta S - alpha alone, up to the square
/// of T/T_m - 1. Without the decrease of the liquid's heat capacity (alpha = 0) the surface exists for every g,
/// including values for which liquid or vapour of the complete model would have a negative heat capacity. In
/// equilibrium the liquid has a different volume, with T/T_m of about 1.15: there the quadratic term is
/// significant, and alpha is kept. The attraction of the vapour has no influence.
eos::GrayConstants for_melting(eos::GrayConstants constants) {
  if (constants.melting != eos::MeltingTransition::equilibrium) {
    constants.melting_entropy -= constants.liquid_heat_coefficient;
    constants.liquid_heat_coefficient = 0.0;
  }
  constants.vapour = eos::VapourCondition::attraction;
  if (!std::isfinite(constants.vapour_attraction)) {
    constants.vapour_attraction =
        std::pow(constants.hugoniot_intercept, 2) * constants.reference_specific_volume;
  }
  return constants;
}
}  // namespace

Melting::Melting(eos::GrayConstants constants) : surface_(for_melting(std::move(constants))) {}

double Melting::solidus(double V) const {
  const double T_m = surface_.melting_temperature(V);
  if (surface_.constants().melting != eos::MeltingTransition::equilibrium) {
    return surface_.band(surface_.isochore(V)).T1;
  }
  // Equal pressure and Gibbs energy of the solid at this volume and a liquid at another volume (G27).
  const auto excess = [&](double T) {
    const eos::GrayPoint solid = surface_.solid(V, T);
    const double volume = condensed_volume(surface_, true, solid.pressure, T);
    return surface_.liquid(volume, T).gibbs(volume, T) - solid.gibbs(V, T);
  };
  // The solid at V melts below T_m(V), where the liquid at the same volume has the same free energy.
  double low = T_m;
  while (low > 0.5 * T_m && excess(low) < 0.0) low *= 0.98;
  return eos::find_root(excess, low, T_m, "melting temperature of the solid's volume");
}

double Melting::latent_heat(double pressure, double temperature) const {
  const auto enthalpy = [&](bool liquid) {
    const double V = condensed_volume(surface_, liquid, pressure, temperature);
    return phase(surface_, liquid, V, temperature).energy + pressure * V;
  };
  return enthalpy(true) - enthalpy(false);
}

double condensed_volume(const eos::GrayFreeEnergy& surface, bool liquid, double pressure,
                        double temperature) {
  double small = surface.least_volume();
  double large = surface.join_volume();
  const auto excess = [&](double V) { return phase(surface, liquid, V, temperature).pressure - pressure; };
  if (!(excess(small) > 0.0 && excess(large) < 0.0)) {
    throw StateError(fmt::format("the model has no {} at {:.4g} GPa and {:.0f} K",
                                 liquid ? "liquid" : "solid", 1e-9 * pressure, temperature));
  }
  while (large - small > 1e-12 * large) {
    const double middle = 0.5 * (small + large);
    (excess(middle) > 0.0 ? small : large) = middle;
  }
  return 0.5 * (small + large);
}

}  // namespace whipple::fit

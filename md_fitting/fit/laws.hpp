// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/models/gray_constants.hpp"
#include "eos/models/gray_free_energy.hpp"
#include "md_fitting/fit/solid_constants.hpp"

/// Evaluates the laws that relate the constants to thermal data of a solid (docs/theory/fit.md, section 1).
/// Electrons are excluded, since the simulations have none. V in m^3/kg, T in K.
namespace whipple::fit {

/// Returns gamma = gamma0 - a (1 - V/V0).
double gamma(const eos::GrayConstants& constants, double V);

/// Returns c T + g_anh (V/V0)^gamma_e T^2/2 per unit mass, J/kg.
double thermal_energy(const SolidConstants& constants, double V, double T);

/// Returns the anharmonic part (Pa) of P - gamma E/V: (gamma_e - gamma) g_anh (V/V0)^gamma_e T^2/(2 V).
double anharmonic_pressure(const eos::GrayConstants& constants, double V, double T);

/// Returns the pressure (Pa) at the reference temperature (Vinet et al., Phys. Rev. B 35 (1987) 1945): with X =
/// (V/V0)^(1/3), 3 K0 (1 - X)/X^2 exp[3/2 (K0' - 1)(1 - X)].
double isotherm_pressure(const SolidConstants& constants, double V);

/// Returns Lindemann's T_m(V) = T_m0 (V/V0)^(-2(gamma0 - 1/3 - a)) exp(2 a (1 - V/V0)).
double melting_temperature(const eos::GrayConstants& constants, double V);

/// Evaluates melting on the GRAY surface. Only here are the electrons of the material included.
class Melting {
 public:
  /// @throws InputError if the constants contradict each other
  explicit Melting(eos::GrayConstants constants);
  /// Returns the temperature at which the solid of a volume begins to melt: the lower edge of the model's melting
  /// band, T_m(V) if it melts isochorically, or the temperature of equilibrium with a liquid of another volume.
  /// @throws StateError if there is none
  [[nodiscard]] double solidus(double V) const;
  /// Returns the enthalpy of the liquid minus that of the solid at a pressure and a temperature, J/kg.
  /// @throws StateError if one of them does not exist there
  [[nodiscard]] double latent_heat(double pressure, double temperature) const;

 private:
  eos::GrayFreeEnergy surface_;
};

/// Returns the volume of the solid or the liquid of GRAY at a pressure and a temperature, m^3/kg.
/// @throws StateError if there is none below the join to the vapour
double condensed_volume(const eos::GrayFreeEnergy& surface, bool liquid, double pressure, double temperature);

}  // namespace whipple::fit

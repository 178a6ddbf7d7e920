// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/models/gray_constants.hpp"
#include "eos/models/gray_free_energy.hpp"
#include "md_fitting/fit/solid_constants.hpp"

/// The laws that tie the constants to thermal data of a solid (docs/theory/fit.md, section 1). The electrons
/// are left out: the simulations hold none. V in m^3/kg, T in K.
namespace whipple::fit {

/// gamma = gamma0 - a (1 - V/V0)
double gamma(const eos::GrayConstants& constants, double V);

/// c T + g_anh (V/V0)^gamma_e T^2/2 per mass, J/kg
double thermal_energy(const SolidConstants& constants, double V, double T);

/// Returns the anharmonic part (Pa) of P - gamma E/V: (gamma_e - gamma) g_anh (V/V0)^gamma_e T^2/(2 V).
double anharmonic_pressure(const eos::GrayConstants& constants, double V, double T);

/// Pressure of the reference temperature (Vinet et al., Phys. Rev. B 35 (1987) 1945), Pa: with X =
/// (V/V0)^(1/3), 3 K0 (1 - X)/X^2 exp[3/2 (K0' - 1)(1 - X)]
double isotherm_pressure(const SolidConstants& constants, double V);

/// T_m(V) = T_m0 (V/V0)^(-2(gamma0 - 1/3 - a)) exp(2 a (1 - V/V0)): Lindemann
double melting_temperature(const eos::GrayConstants& constants, double V);

/// Melting of GRAY's surface. Here, and only here, the electrons of the material count.
class Melting {
 public:
  /// @throws InputError if the constants contradict each other
  explicit Melting(eos::GrayConstants constants);
  /// Temperature at which the solid of a volume begins to melt: the lower edge of the model's melting band,
  /// T_m(V) if it melts isochorically, or where it is in equilibrium with a liquid of another volume.
  /// @throws StateError if there is none
  [[nodiscard]] double solidus(double V) const;
  /// Enthalpy of the liquid over that of the solid at a pressure and a temperature, J/kg.
  /// @throws StateError if one of them does not exist there
  [[nodiscard]] double latent_heat(double pressure, double temperature) const;

 private:
  eos::GrayFreeEnergy surface_;
};

/// Volume of the solid or the liquid of GRAY at a pressure and a temperature, m^3/kg.
/// @throws StateError if there is none below the join to the vapour
double condensed_volume(const eos::GrayFreeEnergy& surface, bool liquid, double pressure, double temperature);

}  // namespace whipple::fit

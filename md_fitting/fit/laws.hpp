// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/models/gray_constants.hpp"
#include "eos/models/gray_free_energy.hpp"

/// The laws of GRAY that tie its constants to thermal data of a solid (docs/theory/fit.md, section 1). The
/// electrons are left out: the simulations hold none. V in m^3/kg, T in K.
namespace whipple::fit {

/// gamma = gamma0 - a (1 - V/V0)
double gamma(const eos::GrayConstants& constants, double V);

/// 3 R T + g_anh (V/V0)^gamma_e T^2/2 per mass, J/kg
double thermal_energy(const eos::GrayConstants& constants, double V, double T);

/// What the anharmonic energy adds to P - gamma E/V: (gamma_e - gamma) g_anh (V/V0)^gamma_e T^2/(2 V), Pa
double anharmonic_pressure(const eos::GrayConstants& constants, double V, double T);

/// T_m(V) = T_m0 (V/V0)^(-2(gamma0 - 1/3 - a)) exp(2 a (1 - V/V0)): Lindemann
double melting_temperature(const eos::GrayConstants& constants, double V);

/// Temperature at which the solid of a volume begins to melt: the lower edge of the model's melting band, or
/// T_m(V) if it melts isochorically. Here, and only here, the electrons of the material count.
class Solidus {
 public:
  /// @throws InputError if the constants contradict each other
  explicit Solidus(eos::GrayConstants constants);
  [[nodiscard]] double temperature(double V) const;

 private:
  eos::GrayFreeEnergy surface_;
};

}  // namespace whipple::fit

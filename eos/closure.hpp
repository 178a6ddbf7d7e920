// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "eos/equation_of_state.hpp"

/// Computes the pressure-temperature equilibrium of several materials in a common volume
/// (docs/theory/equations_of_state.md, "Mixtures in pressure-temperature equilibrium"); SI.
namespace whipple::eos {

struct Component {
  const EquationOfState* eos = nullptr;
  double mass_fraction = 0;  ///< > 0; they sum to 1
};

struct Mixture {
  /// State of the mixture: V = sum x_i V_i, e = sum x_i e_i, s = sum x_i s_i; sound speed, C_v, Gamma and K_T are
  /// those at equilibrium (fixed masses, p and T common at all times). The sound speed is unknown (NaN) where the
  /// equilibrium is not stable.
  State state;
  std::vector<State> components;  ///< at the common pressure and temperature, in the order of the components
  std::vector<double> volume_fractions;  ///< x_i V_i/V
};

/// Computes the equilibrium at the density and specific internal energy of the mixture. Where several exist (a
/// component may melt or not), the one nearest to equal compression of the components is returned.
/// @throws StateError if there is no equilibrium within the models, with the residuals of the last attempt;
/// InputError for mass fractions that are not positive or do not add up to 1 (to 1e-9), or a model without
/// temperature
Mixture mixture_at_energy(std::span<const Component> components, double density,
                          double specific_internal_energy);

/// Computes the equilibrium at pressure and temperature, with each component on the branch through its reference
/// density.
/// @throws StateError if a component has no state there; InputError as above
Mixture mixture_at_pressure_and_temperature(std::span<const Component> components, double pressure,
                                            double temperature);

}  // namespace whipple::eos
